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

// What a file of 0.1.0 does not have: the controls in the hand, three for each HandControls, those of each Pointer, and
// the notes.
constexpr std::array<std::string_view, 3> kHandPlaces{"{up}", "{down}", "{turn-on}"};
constexpr std::array<std::string_view, 18> kHandKeys{
    "mouse-up",  "mouse-down",  "mouse-turn-on",  "pen-up",       "pen-down",       "pen-turn-on",
    "grip-up",   "grip-down",   "grip-turn-on",   "gamepad-up",   "gamepad-down",   "gamepad-turn-on",
    "device-up", "device-down", "device-turn-on", "simulated-up", "simulated-down", "simulated-turn-on"};
static_assert(kHandKeys.size() == kHandPlaces.size() * core::kEnumerators<HandControls>.size());
constexpr std::string_view kChoosePlace = "{choose}";
constexpr std::array<std::string_view, 2> kPointerKeys{"mouse-choose", "wand-choose"};
constexpr std::array<std::string_view, 3> kNoteKeys{"keys", "leave-journey", "leave-analogy"};
constexpr std::size_t kHand = kKeys.size(), kPointer = kHand + kHandKeys.size(), kNote = kPointer + kPointerKeys.size();
constexpr auto kLaterKeys = [] {
  std::array<std::string_view, kHandKeys.size() + kPointerKeys.size() + kNoteKeys.size()> keys{};
  auto* end = std::copy(kHandKeys.begin(), kHandKeys.end(), keys.begin());
  end = std::copy(kPointerKeys.begin(), kPointerKeys.end(), end);
  std::copy(kNoteKeys.begin(), kNoteKeys.end(), end);
  return keys;
}();
constexpr std::array<std::string_view, 4> kPlaces{kHandPlaces[0], kHandPlaces[1], kHandPlaces[2], kChoosePlace};

void put(std::string_view place, const std::string& control, std::string& text) {
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + control.size())) {
    text.replace(at, place.size(), control);
  }
}

// Where the servo accepts Turn-On.
bool is_lifted(const scene::TipState& tip) {
  return tip.phase == physics::Phase::Free && (tip.tip.z_m - tip.active.release_z_m) * tip.active.scale.hand_m_per_m >=
                                                  haptics::SafetyGovernor::kArmingMarginM;
}

// By what is done, not by where the hand happens to move: a tremble turns that round.
Hint step_with_force(const scene::TipState& tip, const StepsDone& done) {
  if (tip.phase == physics::Phase::Attached) {
    if (!done.pressed) return Hint::PressOn;
    return tip.tip.z_m > 0.0 ? Hint::MoveUp : Hint::Pressed;
  }
  return done.let_go && done.ascending ? Hint::LetGo : Hint::MoveDown;
}

}  // namespace

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
      if (tip.phase != physics::Phase::WaitForLift) return step_with_force(tip, done);
      break;
    case scene::ServoState::Disarmed:
      if (is_lifted(tip)) return tip.dead_man != 0 ? Hint::TurnOnAndHold : Hint::TurnOn;
      break;
  }
  return Hint::Lift;
}

core::Result<Guidance> Guidance::load(const std::string& path) {
  auto phrases = load_messages(path, {.keys = kKeys, .optional_keys = kLaterKeys, .places = kPlaces});
  if (!phrases) return tl::unexpected(phrases.error());
  Guidance guidance;
  guidance.phrases_ = std::move(*phrases);
  return guidance;
}

std::string Guidance::text(Hint hint, const Controls& controls) const {
  std::string text = phrases_[core::index_of(hint)];
  for (std::size_t i = 0; i < kHandPlaces.size(); ++i) {
    put(kHandPlaces[i], phrases_[kHand + kHandPlaces.size() * core::index_of(controls.hand) + i], text);
  }
  put(kChoosePlace, phrases_[kPointer + core::index_of(controls.pointer)], text);
  return text;
}

const std::string& Guidance::text(Note note) const { return phrases_[kNote + core::index_of(note)]; }

std::string Guidance::line(Hint hint, const scene::TipState& tip, const Controls& controls) const {
  std::string step = text(hint, controls);
  const bool off = tip.servo_state == scene::ServoState::Disarmed || tip.servo_state == scene::ServoState::Fault;
  if (tip.material < 0 || !off || tip.fault == scene::FaultCode::None) return step;
  return phrases_[kForceOff] + ": " + phrases_[kForceOff + core::index_of(tip.fault)] + ". " + step;
}

}  // namespace afm::exhibit
