// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/heard_event.h"

#include <algorithm>

#include "core/enumerators.h"

namespace afm::exhibit {

namespace {

using enum HeardEvent;

// Notes of the equal temperament, rounded to a hertz: a glide down for closing, up for opening; two notes up for a
// possible start, down for an end; a rough low note, three times, for a failure; a click for a repeated event. Of
// particles: a soft knock for a touch, two for a ride over, a click for a first slip, a long fall for a loss, which a
// rise takes back; of a tapping lever a click with a glide down or up; a short rise for a pull that moves one, a pluck
// for a contact that tears, a long rise for a particle that is lifted, a fall with a knock for one that is set down;
// three notes up for a pattern. On a soft sample a scrape for the first mark, two dull knocks where the tip stops, a
// rough rise for a hand that is too fast. With ink a drop, and a short rise where the liquid tears. A rough note that
// falls for a particle that a scan pushes away. A short step up, in the ear of its side, for one
// that goes astray; a long low note for those that are jammed.
constexpr std::array kRows{
    HeardEventRow{
        SnapIn, Phrase::HeardSnapIn, Phrase::SaySnapIn, Spoken::AtOnce, {{SignalNote{0, 0.100, 1319, 523, 0.30, 0.3}}}},
    HeardEventRow{PullOff,
                  Phrase::HeardPullOff,
                  Phrase::SayPullOff,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.160, 523, 2093, 0.30, 0}}}},
    HeardEventRow{
        Slip, Phrase::HeardSlip, Phrase::SaySlip, Spoken::OnRequest, {{SignalNote{0, 0.010, 2637, 1976, 0.16, 0}}}},
    HeardEventRow{
        Touch, Phrase::HeardTouch, Phrase::SayTouch, Spoken::AtOnce, {{SignalNote{0, 0.050, 294, 196, 0.30, 1.0}}}},
    HeardEventRow{ForceOn,
                  Phrase::HeardForceOn,
                  Phrase::SayForceOn,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.060, 523, 523, 0.22, 0}, SignalNote{0.070, 0.060, 659, 659, 0.22, 0},
                    SignalNote{0.140, 0.100, 784, 784, 0.22, 0}}}},
    HeardEventRow{ForceOff,
                  Phrase::HeardForceOff,
                  Phrase::SayForceOff,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.080, 784, 784, 0.22, 0}, SignalNote{0.090, 0.120, 523, 523, 0.22, 0}}}},
    HeardEventRow{Fault,
                  Phrase::HeardFault,
                  Phrase::SayFault,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.120, 233, 220, 0.30, 1}, SignalNote{0.180, 0.120, 233, 220, 0.30, 1},
                    SignalNote{0.360, 0.160, 233, 196, 0.30, 1}}}},
    HeardEventRow{SampleChosen,
                  Phrase::HeardSample,
                  Phrase::SaySample,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.060, 988, 988, 0.20, 0.5}}}},
    HeardEventRow{TurnOnReady,
                  Phrase::HeardReady,
                  Phrase::SayReady,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.070, 784, 784, 0.20, 0}, SignalNote{0.090, 0.110, 1175, 1175, 0.20, 0}}}},
    HeardEventRow{ScanLine,
                  Phrase::HeardScanLine,
                  Phrase::SayScanLine,
                  Spoken::OnRequest,
                  {{SignalNote{0, 0.016, 1568, 1568, 0.10, 0}}}},
    HeardEventRow{ParticleTouched,
                  Phrase::HeardParticleTouched,
                  Phrase::SayParticleTouched,
                  Spoken::OnRequest,
                  {{SignalNote{0, 0.040, 392, 330, 0.24, 0.6}}}},
    HeardEventRow{ParticleGave,
                  Phrase::HeardParticleGave,
                  Phrase::SayParticleGave,
                  Spoken::OnRequest,
                  {{SignalNote{0, 0.016, 1760, 1319, 0.20, 0}}}},
    HeardEventRow{ParticleLost,
                  Phrase::HeardParticleLost,
                  Phrase::SayParticleLost,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.220, 880, 330, 0.26, 0}}}},
    HeardEventRow{ParticleRiddenOver,
                  Phrase::HeardParticleRiddenOver,
                  Phrase::SayParticleRiddenOver,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.040, 392, 330, 0.26, 0.6}, SignalNote{0.110, 0.040, 392, 330, 0.26, 0.6}}}},
    HeardEventRow{ParticleDragged,
                  Phrase::HeardParticleDragged,
                  Phrase::SayParticleDragged,
                  Spoken::OnRequest,
                  {{SignalNote{0, 0.060, 494, 659, 0.20, 0.3}}}},
    HeardEventRow{ParticleTorn,
                  Phrase::HeardParticleTorn,
                  Phrase::SayParticleTorn,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.120, 784, 1568, 0.26, 0.6}}}},
    HeardEventRow{PushTakenBack,
                  Phrase::HeardPushTakenBack,
                  Phrase::SayPushTakenBack,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.160, 330, 880, 0.22, 0}}}},
    HeardEventRow{ParticlesPutBack,
                  Phrase::HeardParticlesPutBack,
                  Phrase::SayParticlesPutBack,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.160, 330, 880, 0.22, 0}, SignalNote{0.180, 0.160, 330, 880, 0.22, 0}}}},
    HeardEventRow{PatternDone,
                  Phrase::HeardPatternDone,
                  Phrase::SayPatternDone,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.090, 659, 659, 0.24, 0}, SignalNote{0.110, 0.090, 880, 880, 0.24, 0},
                    SignalNote{0.220, 0.240, 1319, 1319, 0.24, 0}}}},
    HeardEventRow{JumpToRepulsion,
                  Phrase::HeardJumpToRepulsion,
                  Phrase::SayJumpToRepulsion,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.012, 2349, 1175, 0.26, 0}, SignalNote{0.020, 0.080, 587, 392, 0.26, 0.3}}}},
    HeardEventRow{JumpToAttraction,
                  Phrase::HeardJumpToAttraction,
                  Phrase::SayJumpToAttraction,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.012, 1175, 2349, 0.26, 0}, SignalNote{0.020, 0.080, 392, 587, 0.26, 0.3}}}},
    HeardEventRow{ParticleLifted,
                  Phrase::HeardParticleLifted,
                  Phrase::SayParticleLifted,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.220, 440, 1319, 0.24, 0}}}},
    HeardEventRow{ParticleSetDown,
                  Phrase::HeardParticleSetDown,
                  Phrase::SayParticleSetDown,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.120, 880, 440, 0.22, 0}, SignalNote{0.130, 0.040, 330, 262, 0.26, 0.6}}}},
    HeardEventRow{LookedAgain,
                  Phrase::HeardLookedAgain,
                  Phrase::SayLookedAgain,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.060, 1175, 1175, 0.20, 0}, SignalNote{0.090, 0.060, 1568, 1568, 0.20, 0}}}},
    HeardEventRow{SurfaceMarked,
                  Phrase::HeardSurfaceMarked,
                  Phrase::SaySurfaceMarked,
                  Spoken::OnRequest,
                  {{SignalNote{0, 0.090, 349, 294, 0.22, 1.0}}}},
    HeardEventRow{TipStopped,
                  Phrase::HeardTipStopped,
                  Phrase::SayTipStopped,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.050, 262, 220, 0.28, 0.6}, SignalNote{0.080, 0.050, 262, 220, 0.28, 0.6}}}},
    HeardEventRow{HandTooFast,
                  Phrase::HeardHandTooFast,
                  Phrase::SayHandTooFast,
                  Spoken::OnRequest,
                  {{SignalNote{0, 0.120, 392, 784, 0.22, 0.6}}}},
    HeardEventRow{InkFlows,
                  Phrase::HeardInkFlows,
                  Phrase::SayInkFlows,
                  Spoken::OnRequest,
                  {{SignalNote{0, 0.070, 523, 698, 0.20, 0.1}}}},
    HeardEventRow{LiquidTorn,
                  Phrase::HeardLiquidTorn,
                  Phrase::SayLiquidTorn,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.100, 587, 1175, 0.24, 0.3}}}},
    HeardEventRow{ParticleSwept,
                  Phrase::HeardParticleSwept,
                  Phrase::SayParticleSwept,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.050, 659, 659, 0.22, 0.6}, SignalNote{0.070, 0.140, 659, 349, 0.24, 0.6}}}},
    HeardEventRow{ParticleAstray,
                  Phrase::HeardAstrayRight,
                  Phrase::SayAstrayRight,
                  Spoken::OnRequest,
                  {{SignalNote{0, 0.050, 587, 698, 0.16, 0.2}}}},
    HeardEventRow{ParticleJammed,
                  Phrase::HeardParticleJammed,
                  Phrase::SayParticleJammed,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.260, 147, 139, 0.30, 0.7}}}},
    HeardEventRow{ParticleFarEnough,
                  Phrase::HeardFarEnough,
                  Phrase::SayFarEnough,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.080, 880, 880, 0.24, 0}, SignalNote{0.100, 0.160, 1175, 1175, 0.24, 0}}}},
    HeardEventRow{BlindTaskDone,
                  Phrase::HeardBlindTaskDone,
                  Phrase::SayBlindTaskDone,
                  Spoken::AtOnce,
                  {{SignalNote{0, 0.090, 784, 784, 0.24, 0}, SignalNote{0.110, 0.090, 1047, 1047, 0.24, 0},
                    SignalNote{0.220, 0.240, 1568, 1568, 0.24, 0}}}},
};
static_assert(kRows.size() == core::kEnumerators<HeardEvent>.size());
static_assert([] {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (kRows[i].event != core::kEnumerators<HeardEvent>[i]) return false;
  }
  return true;
}());

}  // namespace

double Signal::length_s() const {
  double end_s = 0;
  for (const SignalNote& note : notes) end_s = std::max(end_s, note.start_s + note.length_s);
  return end_s;
}

const HeardEventRow& row_of(HeardEvent event) { return kRows[core::index_of(event)]; }

}  // namespace afm::exhibit
