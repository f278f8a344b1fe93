// SPDX-License-Identifier: Apache-2.0
#include "app/live/view_keys.h"

#include <array>
#include <string>
#include <string_view>

#include "app/live/live_view.h"

namespace afm::app {

namespace {

using render::Key;

constexpr double kEyeStepM = 1e-3;
constexpr double kHeadStepM = 0.05;

}  // namespace

std::span<const LiveKey> live_keys() {
  static constexpr std::array kKeys{
      LiveKey{Key::Digit1, "1 to 9", "Choose a sample", [](LiveView& view, std::size_t number) { view.choose(number); },
              "left click", Key::Digit9},
      LiveKey{MouseHand::kGripKey, "Space", "Move the hand", nullptr, "right drag, wheel"},
      LiveKey{MouseHand::kTurnOnKey, "T", "Turn-On", nullptr, "middle click"},
      LiveKey{Key::Enter, "Enter", "Stop: no force, at once", [](LiveView& view, std::size_t) { view.stop_force(); }},
      LiveKey{Key::F2, "F2", "Parameters", [](LiveView& view, std::size_t) { view.panels_.toggle_parameters(); }},
      LiveKey{Key::M, "M", "Next scale of the hand", [](LiveView& view, std::size_t) { view.next_scale(); }}
          .for_staff(),
      LiveKey{Key::J, "J", "Journey of scale, and back",
              [](LiveView& view, std::size_t) { view.turn_journey_round(); }},
      LiveKey{Key::A, "A", "A magnet on a spring instead", [](LiveView& view, std::size_t) { view.toggle_analogy(); }},
      LiveKey{Key::R, "R", "Begin again", [](LiveView& view, std::size_t) { view.begin_again(); }},
      LiveKey{Key::H, "H", "Scene back to its place", [](LiveView& view, std::size_t) { view.bring_home(); }},
      LiveKey{Key::Left, "Left", "Head left, right",
              [](LiveView& view, std::size_t) { view.move_head(-kHeadStepM, 0.0, 0.0); }}
          .for_staff(),
      LiveKey{Key::Right, "Right", "Head left, right",
              [](LiveView& view, std::size_t) { view.move_head(kHeadStepM, 0.0, 0.0); }}
          .for_staff(),
      LiveKey{Key::Up, "Up", "Head up, down", [](LiveView& view, std::size_t) { view.move_head(0.0, kHeadStepM, 0.0); }}
          .for_staff(),
      LiveKey{Key::Down, "Down", "Head up, down",
              [](LiveView& view, std::size_t) { view.move_head(0.0, -kHeadStepM, 0.0); }}
          .for_staff(),
      LiveKey{Key::PageUp, "PgUp", "Head nearer, farther",
              [](LiveView& view, std::size_t) { view.move_head(0.0, 0.0, kHeadStepM); }}
          .for_staff(),
      LiveKey{Key::PageDown, "PgDn", "Head nearer, farther",
              [](LiveView& view, std::size_t) { view.move_head(0.0, 0.0, -kHeadStepM); }}
          .for_staff(),
      LiveKey{Key::P, "P", "Hide the panels", [](LiveView& view, std::size_t) { view.panels_.toggle_all(); }}
          .for_staff(),
      LiveKey{Key::S, "S", "Swap the eyes", [](LiveView& view, std::size_t) { view.picture_.swap_eyes(); }}.for_staff(),
      LiveKey{Key::V, "V", "Stereo mode: next, before",
              [](LiveView& view, std::size_t) { view.picture_.change_mode(ViewPicture::Step::Next); }}
          .for_staff(),
      LiveKey{Key::C, "C", "Stereo mode: next, before",
              [](LiveView& view, std::size_t) { view.picture_.change_mode(ViewPicture::Step::Previous); }}
          .for_staff(),
      LiveKey{Key::LeftBracket, "[", "Eyes 1 mm nearer, farther",
              [](LiveView& view, std::size_t) { view.picture_.widen_eyes(-kEyeStepM); }}
          .for_staff(),
      LiveKey{Key::RightBracket, "]", "Eyes 1 mm nearer, farther",
              [](LiveView& view, std::size_t) { view.picture_.widen_eyes(kEyeStepM); }}
          .for_staff(),
      LiveKey{Key::G, "G", "Test pattern", [](LiveView& view, std::size_t) { view.picture_.toggle_calibration(); }}
          .for_staff(),
      LiveKey{Key::B, "B", "Contact to the wall's plane", [](LiveView& view, std::size_t) { view.bring_to_wall(); }}
          .for_staff(),
      LiveKey{Key::F11, "F11", "Full screen", [](LiveView& view, std::size_t) { view.windows_.toggle_full_screen(); }}
          .for_staff(),
      LiveKey{Key::F12, "F12", "Save the picture", [](LiveView& view, std::size_t) { view.picture_.save(); }}
          .for_staff(),
      LiveKey{Key::Escape, "Esc", "End", [](LiveView& view, std::size_t) { view.leaving_ = true; }}.for_staff(),
      LiveKey{Key::F1, "F1", "", [](LiveView& view, std::size_t) { view.panels_.toggle_keys(); }},
  };
  return kKeys;
}

render::DataPanel key_list(HandSource hand, bool unattended) {
  render::DataPanel panel;
  panel.title = "Keys";
  panel.subtitle = "F1 hides them";
  std::string_view text_above;
  for (const LiveKey& key : live_keys()) {
    const std::string_view text = key.text;
    if (text.empty() || (key.press == nullptr && hand != HandSource::Mouse) || (key.staff && unattended)) {
      continue;
    }
    if (text == text_above) {
      panel.rows.back().value += std::string(", ") + key.name;
      continue;
    }
    text_above = text;
    const std::string_view mouse = key.mouse;
    // without notes below them: with those the rows would stand on one another
    panel.rows.push_back({key.text, key.name + (mouse.empty() ? "" : ", " + std::string(mouse)), ""});
  }
  return panel;
}

}  // namespace afm::app
