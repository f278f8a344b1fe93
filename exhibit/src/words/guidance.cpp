// SPDX-License-Identifier: Apache-2.0
#include "exhibit/words/guidance.h"

#include <array>
#include <string>

#include "core/enumerators.h"
#include "haptics/safety.h"

namespace afm::exhibit {

namespace {

constexpr std::size_t kControlsOfHand = 3;  // number of controls: up, down and Turn-On

// check that each run of phrases has a row per enumerator
static_assert(after(Phrase::ChooseSample, core::kEnumerators<Hint>.size()) == Phrase::ForceOff);
static_assert(after(Phrase::ForceOff, scene::kFaultTexts.size()) == Phrase::MouseUp);
static_assert(after(Phrase::MouseUp, kControlsOfHand* core::kEnumerators<HandControls>.size()) == Phrase::MouseChoose);
static_assert(after(Phrase::MouseChoose, core::kEnumerators<Pointer>.size()) == Phrase::AllKeys);
static_assert(after(Phrase::AllKeys, core::kEnumerators<Note>.size()) == Phrase::ChangeParameters);
static_assert([] {
  for (std::size_t i = 0; i < scene::kFaultTexts.size(); ++i) {
    if (row_of(after(Phrase::ForceOff, i)).key != scene::kFaultTexts[i].key) return false;
  }
  return true;
}());

// True if the tip is high enough for the servo to accept Turn-On.
bool is_lifted(const scene::TipState& tip) {
  return tip.phase == physics::Phase::Free && (tip.tip.z_m - tip.active.release_z_m) * tip.active.scale.hand_m_per_m >=
                                                  haptics::SafetyGovernor::kArmingMarginM;
}

// Steps with force if the tip pushes particles.
Hint step_among_particles(const scene::TipState& tip) {
  return tip.phase == physics::Phase::Attached ? Hint::PushAside : Hint::GoBeside;
}

// Steps with force of a lever that taps: it neither snaps in nor pulls off.
Hint step_with_swing(const StepsDone& done) {
  if (*done.swing_taken) return Hint::GiveSwing;
  return done.let_go && done.ascending ? Hint::SwingsFree : Hint::TakeSwing;
}

// Step from the steps done instead of the hand's direction, which reverses with every tremor.
Hint step_with_force(const scene::TipState& tip, const StepsDone& done) {
  if (tip.phase == physics::Phase::Attached) {
    if (!done.pressed) return Hint::PressOn;
    return tip.tip.z_m > 0.0 ? Hint::MoveUp : Hint::Pressed;
  }
  return done.let_go && done.ascending ? Hint::LetGo : Hint::MoveDown;
}

}  // namespace

bool pushes_particles(const scene::TipState& tip) { return tip.active.scale_mode == scene::ScaleMode::Particles; }

Hint next_step(const scene::TipState& tip, const StepsDone& done) {
  if (tip.material < 0) return Hint::ChooseSample;
  switch (tip.servo_state) {
    case scene::ServoState::Arming:
      return Hint::ComingOn;
    case scene::ServoState::Fading:
      return Hint::GoingOff;
    case scene::ServoState::Fault:
      return Hint::PressToGoOn;
    case scene::ServoState::Running:
      if (tip.phase == physics::Phase::WaitForLift) break;
      if (pushes_particles(tip)) return step_among_particles(tip);
      return done.swing_taken ? step_with_swing(done) : step_with_force(tip, done);
    case scene::ServoState::Disarmed:
      if (is_lifted(tip)) return tip.dead_man != 0 ? Hint::TurnOnAndHold : Hint::TurnOn;
      break;
  }
  return Hint::Lift;
}

const std::string& note_text(const Phrases& phrases, Note note) {
  return phrases[after(Phrase::AllKeys, core::index_of(note))];
}

std::string step_text(const Phrases& phrases, Hint hint, const Controls& controls) {
  const Phrase up = after(Phrase::MouseUp, kControlsOfHand * core::index_of(controls.hand));
  const std::array<std::string, 4> values{phrases[up], phrases[after(up, 1)], phrases[after(up, 2)],
                                          phrases[after(Phrase::MouseChoose, core::index_of(controls.pointer))]};
  return phrases.filled(after(Phrase::ChooseSample, core::index_of(hint)), values);
}

std::string guidance_line(const Phrases& phrases, Hint hint, const scene::TipState& tip, const Controls& controls) {
  std::string step = step_text(phrases, hint, controls);
  const bool off = tip.servo_state == scene::ServoState::Disarmed || tip.servo_state == scene::ServoState::Fault;
  const bool unasked = tip.fault != scene::FaultCode::None && tip.fault != scene::FaultCode::StopPressed;
  if (tip.material < 0 || !off || !unasked) return step;
  const std::string& reason = phrases[after(Phrase::ForceOff, core::index_of(tip.fault))];
  return phrases[Phrase::ForceOff] + ": " + reason + ". " + step;
}

std::string no_sample_advice(const Phrases& phrases, Pointer pointer) {
  const std::array values{phrases[after(Phrase::MouseChoose, core::index_of(pointer))]};
  return phrases.filled(Phrase::NoSampleAdvice, values);
}

}  // namespace afm::exhibit
