// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/tip_ear.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/enumerators.h"

namespace afm::exhibit {

namespace {

enum class ForceOf { Nothing, Before, After };  // side of the event whose force is heard

struct EventRow {
  physics::EventKind kind;
  HeardEvent heard;
  ForceOf force;
};

constexpr auto kRows = std::to_array<EventRow>({
    {physics::EventKind::JumpToContact, HeardEvent::SnapIn, ForceOf::After},
    {physics::EventKind::JumpOffContact, HeardEvent::PullOff, ForceOf::Before},
    {physics::EventKind::Slip, HeardEvent::Slip, ForceOf::Before},
    {physics::EventKind::ParticleTouched, HeardEvent::ParticleTouched, ForceOf::After},
    {physics::EventKind::ParticleGave, HeardEvent::ParticleGave, ForceOf::Before},
    {physics::EventKind::ParticleLost, HeardEvent::ParticleLost, ForceOf::Before},
    {physics::EventKind::ParticleRiddenOver, HeardEvent::ParticleRiddenOver, ForceOf::Before},
    {physics::EventKind::PushTakenBack, HeardEvent::PushTakenBack, ForceOf::Nothing},
    {physics::EventKind::ParticlesPutBack, HeardEvent::ParticlesPutBack, ForceOf::Nothing},
    {physics::EventKind::ParticleDragged, HeardEvent::ParticleDragged, ForceOf::Before},
    {physics::EventKind::ParticleTorn, HeardEvent::ParticleTorn, ForceOf::Before},
    {physics::EventKind::JumpToRepulsion, HeardEvent::JumpToRepulsion, ForceOf::After},
    {physics::EventKind::JumpToAttraction, HeardEvent::JumpToAttraction, ForceOf::After},
    {physics::EventKind::ParticleLifted, HeardEvent::ParticleLifted, ForceOf::Before},
    {physics::EventKind::ParticleSetDown, HeardEvent::ParticleSetDown, ForceOf::Nothing},
    {physics::EventKind::LookedAgain, HeardEvent::LookedAgain, ForceOf::Nothing},
    {physics::EventKind::SurfaceMarked, HeardEvent::SurfaceMarked, ForceOf::After},
    {physics::EventKind::TipStopped, HeardEvent::TipStopped, ForceOf::After},
    {physics::EventKind::HandTooFast, HeardEvent::HandTooFast, ForceOf::Nothing},
    {physics::EventKind::InkFlows, HeardEvent::InkFlows, ForceOf::Nothing},
    {physics::EventKind::LiquidTorn, HeardEvent::LiquidTorn, ForceOf::Before},
    {physics::EventKind::ParticleSwept, HeardEvent::ParticleSwept, ForceOf::Before},
});
static_assert(core::has_row_for_each(kRows, &EventRow::kind));

}  // namespace

Heard heard_of(const scene::TipEvent& event) {
  const EventRow& row = kRows[core::index_of(event.kind)];
  const double force_n = row.force == ForceOf::Before  ? event.force_before_n
                         : row.force == ForceOf::After ? event.force_after_n
                                                       : 0.0;
  return {.event = row.heard, .time_ns = event.time_ns, .force_n = force_n, .material = event.material};
}

double side_of(const Heard& heard, const Ear& ear) {
  constexpr double kAstraySide = 0.7;
  if (heard.event == HeardEvent::ParticleAstray) return std::copysign(kAstraySide, heard.force_n);
  const bool jump = heard.event == HeardEvent::SnapIn || heard.event == HeardEvent::PullOff;
  return jump ? ear.tone(heard.force_n).side : 0.0;
}

bool is_audible(const scene::TipSample& sample) {
  return sample.servo_state == scene::ServoState::Running && sample.phase != physics::Phase::WaitForLift;
}

std::optional<HeardEvent> TipEar::change_of_force(scene::ServoState state) {
  using enum scene::ServoState;
  const scene::ServoState before = std::exchange(state_, state);
  if (state == before) return std::nullopt;
  if (state == Fault) {
    on_ = false;
    return HeardEvent::Fault;
  }
  if (state == Running) {
    on_ = true;
    return HeardEvent::ForceOn;
  }
  // fading out, or cut at once
  if (on_ && (state == Fading || state == Disarmed)) {
    on_ = false;
    return HeardEvent::ForceOff;
  }
  return std::nullopt;
}

bool TipEar::touches(const scene::TipSample& sample) {
  const bool pushed = sample.tip.force_n > 0.0;
  const bool taps = sample.swing.amplitude_m > 0.0;  // true in tapping mode, which touches in every swing
  const bool felt = is_audible(sample) && !taps;
  // under a law without a pull, the push begins at contact
  if (!felt || sample.phase == physics::Phase::Free) may_touch_ = felt && !pushed;
  const bool touch = felt && pushed && may_touch_;
  if (touch) may_touch_ = false;
  return touch;
}

std::optional<Heard> TipEar::add(const scene::TipSample& sample) {
  const double before_n = std::exchange(last_force_n_, sample.tip.force_n);
  const std::int64_t before_ns = std::exchange(last_ns_, sample.time_ns);
  const bool touch = touches(sample);
  const PushEar::Astray astray = push_.add(sample);
  if (const auto change = change_of_force(sample.servo_state)) {
    // after Stop this is no fault, whatever the governor's state
    const bool stopped = *change == HeardEvent::Fault && sample.renderer == scene::RendererLink::Stopped;
    return Heard{
        .event = stopped ? HeardEvent::ForceOff : *change, .time_ns = sample.time_ns, .material = sample.material};
  }
  if (astray != PushEar::Astray::No && is_audible(sample)) {
    const bool left = astray == PushEar::Astray::Left;
    return Heard{.event = HeardEvent::ParticleAstray,
                 .time_ns = sample.time_ns,
                 .force_n = left ? -push().force_n : push().force_n,
                 .material = sample.material};
  }
  if (!touch) return std::nullopt;
  // time at which the force crossed zero between the two ticks
  const double rise_n = sample.tip.force_n - before_n;
  const double share = before_n <= 0.0 && rise_n > 0.0 ? -before_n / rise_n : 1.0;
  const auto part_ns = static_cast<std::int64_t>(share * static_cast<double>(sample.time_ns - before_ns));
  return Heard{.event = HeardEvent::Touch, .time_ns = before_ns + part_ns, .material = sample.material};
}

}  // namespace afm::exhibit
