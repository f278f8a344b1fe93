// SPDX-License-Identifier: Apache-2.0
#include "app/live/view_keys.h"

#include <array>

namespace afm::app {

namespace {

struct KeyBinding {
  render::Key key;
  ViewAction action;
  const char* what;  // as the list on the wall says it; null: beside another key
  const char* key_name;
};

constexpr std::array kBindings{
    KeyBinding{render::Key::F2, ViewAction::ShowParameters, "Parameters", "F2"},
    KeyBinding{render::Key::M, ViewAction::NextScale, "Next scale of the hand", "M"},
    KeyBinding{render::Key::J, ViewAction::Journey, "Journey of scale, and back", "J"},
    KeyBinding{render::Key::A, ViewAction::Analogy, "A magnet on a spring instead", "A"},
    KeyBinding{render::Key::R, ViewAction::BeginAgain, "Begin again", "R"},
    KeyBinding{render::Key::H, ViewAction::Home, "Scene back to its place", "H"},
    KeyBinding{render::Key::P, ViewAction::HidePanels, "Hide the panels", "P"},
    KeyBinding{render::Key::S, ViewAction::SwapEyes, "Swap the eyes", "S"},
    KeyBinding{render::Key::V, ViewAction::NextStereo, "Stereo mode: next, before", "V, C"},
    KeyBinding{render::Key::C, ViewAction::PreviousStereo, nullptr, "C"},
    KeyBinding{render::Key::RightBracket, ViewAction::WidenEyes, "Eyes 1 mm nearer, farther", "[, ]"},
    KeyBinding{render::Key::LeftBracket, ViewAction::NarrowEyes, nullptr, "["},
    KeyBinding{render::Key::G, ViewAction::ShowCalibration, "Test pattern", "G"},
    KeyBinding{render::Key::B, ViewAction::BringToWall, "Contact to the wall's plane", "B"},
    KeyBinding{render::Key::F11, ViewAction::FullScreen, "Full screen", "F11"},
    KeyBinding{render::Key::F12, ViewAction::SavePicture, "Save the picture", "F12"},
    KeyBinding{render::Key::Escape, ViewAction::Leave, "End", "Esc"},
    KeyBinding{render::Key::F1, ViewAction::ShowKeys, nullptr, "F1"},
};

}  // namespace

std::optional<ViewAction> action_of(render::Key key) {
  for (const KeyBinding& binding : kBindings) {
    if (binding.key == key) return binding.action;
  }
  return std::nullopt;
}

std::optional<std::size_t> digit(render::Key key) {
  if (key < render::Key::Digit1 || key > render::Key::Digit9) return std::nullopt;
  return static_cast<std::size_t>(key) - static_cast<std::size_t>(render::Key::Digit1);
}

render::DataPanel key_list(HandSource hand) {
  render::DataPanel panel;
  panel.title = "Keys";
  panel.subtitle = "F1 hides them";
  // without notes below them: with those the rows would stand on one another
  panel.rows = {{"Choose a sample", "left click, 1 to 9", ""}};
  if (hand == HandSource::Mouse) {
    panel.rows.insert(panel.rows.end(),
                      {{"Move the hand", "right drag, wheel", ""}, {"Turn-On", "T, middle click", ""}});
  }
  for (const KeyBinding& binding : kBindings) {
    if (binding.what != nullptr) panel.rows.push_back({binding.what, binding.key_name, ""});
  }
  return panel;
}

}  // namespace afm::app
