// SPDX-License-Identifier: Apache-2.0
#include "exhibit/guidance.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/enumerators.h"
#include "exhibit/message_catalog.h"
#include "haptics/safety.h"

namespace afm::exhibit {

namespace {

constexpr std::array<std::string_view, 13> kHintKeys{
    "choose-sample", "lift",    "turn-on", "turn-on-and-hold", "coming-on",      "going-off",  "move-down",
    "press-on",      "pressed", "move-up", "let-go",           "press-to-go-on", "servo-ended"};
static_assert(kHintKeys.size() == core::kEnumerators<Hint>.size());

// The hints, then the faults from None on, whose words stand before a reason.
constexpr std::size_t kForceOff = kHintKeys.size();
constexpr auto kKeys = [] {
  std::array<std::string_view, kHintKeys.size() + scene::kFaultTexts.size()> keys{};
  std::copy(kHintKeys.begin(), kHintKeys.end(), keys.begin());
  for (std::size_t i = 0; i < scene::kFaultTexts.size(); ++i) keys[kForceOff + i] = scene::kFaultTexts[i].key;
  return keys;
}();

// Where the servo accepts Turn-On.
bool is_lifted(const scene::TipState& tip) {
  return tip.phase == physics::Phase::Free && (tip.tip.z_m - tip.active.release_z_m) * tip.active.scale.hand_m_per_m >=
                                                  haptics::SafetyGovernor::kArmingMarginM;
}

Hint step_with_force(const scene::TipState& tip, bool ascending, int cycles) {
  if (tip.phase == physics::Phase::Attached) {
    if (ascending) return Hint::MoveUp;
    return tip.tip.z_m > 0.0 ? Hint::PressOn : Hint::Pressed;
  }
  return cycles > 0 && ascending ? Hint::LetGo : Hint::MoveDown;
}

}  // namespace

Hint next_step(const scene::TipState& tip, bool ascending, int cycles) {
  if (tip.material < 0) return Hint::ChooseSample;
  switch (tip.servo_state) {
    case scene::ServoState::Arming:
      return Hint::ComingOn;
    case scene::ServoState::Fading:
      return Hint::GoingOff;
    case scene::ServoState::Fault:
      return Hint::PressToGoOn;
    case scene::ServoState::Running:
      if (tip.phase != physics::Phase::WaitForLift) return step_with_force(tip, ascending, cycles);
      break;
    case scene::ServoState::Disarmed:
      if (is_lifted(tip)) return tip.dead_man != 0 ? Hint::TurnOnAndHold : Hint::TurnOn;
      break;
  }
  return Hint::Lift;
}

core::Result<Guidance> Guidance::load(const std::string& path) {
  auto phrases = load_messages(path, kKeys);
  if (!phrases) return tl::unexpected(phrases.error());
  Guidance guidance;
  guidance.phrases_ = std::move(*phrases);
  return guidance;
}

const std::string& Guidance::text(Hint hint) const { return phrases_[core::index_of(hint)]; }

std::string Guidance::line(const scene::TipState& tip, bool ascending, int cycles) const {
  const std::string& step = text(next_step(tip, ascending, cycles));
  const bool off = tip.servo_state == scene::ServoState::Disarmed || tip.servo_state == scene::ServoState::Fault;
  if (tip.material < 0 || !off || tip.fault == scene::FaultCode::None) return step;
  return phrases_[kForceOff] + ": " + phrases_[kForceOff + core::index_of(tip.fault)] + ". " + step;
}

}  // namespace afm::exhibit
