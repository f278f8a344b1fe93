// SPDX-License-Identifier: Apache-2.0
#include "app/live/view_keys.h"

#include <array>
#include <string>

#include "app/live/live_view.h"

namespace afm::app {

namespace {

using exhibit::Phrase;
using render::Key;

constexpr double kEyeStepM = 1e-3;
constexpr double kHeadStepM = 0.05;

}  // namespace

// A friend of LiveView, so that a row may call what is private there.
struct LiveKeyTable {
  static constexpr std::array kRows{
      LiveKey{Key::Digit1, "1 to 9", Phrase::KeyChoose, [](LiveView& view, std::size_t number) { view.number(number); },
              Phrase::LeftClick, Key::Digit9},
      LiveKey{MouseHand::kGripKey, "Space", Phrase::KeyHand, nullptr, Phrase::RightDragOrWheel},
      LiveKey{MouseHand::kTurnOnKey, "T", Phrase::KeyTurnOn, nullptr, Phrase::MiddleClick},
      LiveKey{Key::Enter, "Enter", Phrase::KeyStop, [](LiveView& view, std::size_t) { view.stop_or_go_on(); }},
      LiveKey{Key::F2, "F2", Phrase::KeyParameters,
              [](LiveView& view, std::size_t) { view.panels_.toggle_parameters(); }}
          .outside_lessons(),
      LiveKey{Key::I, "I", Phrase::KeyScan, [](LiveView& view, std::size_t) { view.toggle_scan(); }}.outside_lessons(),
      LiveKey{Key::U, "U", Phrase::KeyTruth, [](LiveView& view, std::size_t) { view.toggle_truth(); }}
          .outside_lessons(),
      LiveKey{Key::F, "F", Phrase::KeyFriction, [](LiveView& view, std::size_t) { view.toggle_friction_loop(); }}
          .outside_lessons(),
      LiveKey{Key::L, "L", Phrase::KeyScanHand, [](LiveView& view, std::size_t) { view.next_scan_hand(); }}
          .outside_lessons(),
      LiveKey{Key::K, "K", Phrase::KeyScanFeedback, [](LiveView& view, std::size_t) { view.toggle_scan_feedback(); }}
          .outside_lessons(),
      LiveKey{Key::Tab, "Tab", Phrase::KeyNextSetting, [](LiveView& view, std::size_t) { view.mark_next_setting(); }}
          .outside_lessons(),
      LiveKey{Key::Equal, "+", Phrase::KeyChangeSetting, [](LiveView& view, std::size_t) { view.step_setting(1); }},
      LiveKey{Key::Minus, "-", Phrase::KeyChangeSetting, [](LiveView& view, std::size_t) { view.step_setting(-1); }},
      LiveKey{Key::M, "M", Phrase::KeyScale, [](LiveView& view, std::size_t) { view.next_scale(); }}
          .outside_lessons()
          .for_staff(),
      LiveKey{Key::J, "J", Phrase::KeyJourney, [](LiveView& view, std::size_t) { view.turn_journey_round(); }}
          .outside_lessons(),
      LiveKey{Key::A, "A", Phrase::KeyAnalogy, [](LiveView& view, std::size_t) { view.toggle_analogy(); }}
          .outside_lessons(),
      LiveKey{Key::Y, "Y", Phrase::KeySay,
              [](LiveView& view, std::size_t) { view.sound_.say_state(view.servo_.link().tip()); }},
      LiveKey{Key::Q, "Q", Phrase::KeySound, [](LiveView& view, std::size_t) { view.sound_.toggle(); }},
      LiveKey{Key::X, "X", Phrase::KeyBlank, [](LiveView& view, std::size_t) { view.toggle_picture(); }}.for_staff(),
      LiveKey{Key::R, "R", Phrase::KeyStartAgain, [](LiveView& view, std::size_t) { view.begin_again(); }},
      LiveKey{Key::H, "H", Phrase::KeyHome, [](LiveView& view, std::size_t) { view.bring_home(); }},
      LiveKey{Key::Left, "Left", Phrase::KeyHeadAcross,
              [](LiveView& view, std::size_t) { view.move_head(-kHeadStepM, 0.0, 0.0); }}
          .for_staff(),
      LiveKey{Key::Right, "Right", Phrase::KeyHeadAcross,
              [](LiveView& view, std::size_t) { view.move_head(kHeadStepM, 0.0, 0.0); }}
          .for_staff(),
      LiveKey{Key::Up, "Up", Phrase::KeyHeadHeight,
              [](LiveView& view, std::size_t) { view.move_head(0.0, kHeadStepM, 0.0); }}
          .for_staff(),
      LiveKey{Key::Down, "Down", Phrase::KeyHeadHeight,
              [](LiveView& view, std::size_t) { view.move_head(0.0, -kHeadStepM, 0.0); }}
          .for_staff(),
      LiveKey{Key::PageUp, "PgUp", Phrase::KeyHeadDistance,
              [](LiveView& view, std::size_t) { view.move_head(0.0, 0.0, kHeadStepM); }}
          .for_staff(),
      LiveKey{Key::PageDown, "PgDn", Phrase::KeyHeadDistance,
              [](LiveView& view, std::size_t) { view.move_head(0.0, 0.0, -kHeadStepM); }}
          .for_staff(),
      LiveKey{Key::P, "P", Phrase::KeyPanels, [](LiveView& view, std::size_t) { view.panels_.toggle_all(); }}
          .outside_lessons()
          .for_staff(),
      LiveKey{Key::S, "S", Phrase::KeySwapEyes, [](LiveView& view, std::size_t) { view.picture_.swap_eyes(); }}
          .for_staff(),
      LiveKey{Key::V, "V", Phrase::KeyStereoMode,
              [](LiveView& view, std::size_t) { view.picture_.change_mode(ViewPicture::Step::Next); }}
          .for_staff(),
      LiveKey{Key::C, "C", Phrase::KeyStereoMode,
              [](LiveView& view, std::size_t) { view.picture_.change_mode(ViewPicture::Step::Previous); }}
          .for_staff(),
      LiveKey{Key::LeftBracket, "[", Phrase::KeyEyeDistance,
              [](LiveView& view, std::size_t) { view.picture_.widen_eyes(-kEyeStepM); }}
          .for_staff(),
      LiveKey{Key::RightBracket, "]", Phrase::KeyEyeDistance,
              [](LiveView& view, std::size_t) { view.picture_.widen_eyes(kEyeStepM); }}
          .for_staff(),
      LiveKey{Key::G, "G", Phrase::KeyTestPattern,
              [](LiveView& view, std::size_t) { view.picture_.toggle_calibration(); }}
          .for_staff(),
      LiveKey{Key::B, "B", Phrase::KeyContactToWall, [](LiveView& view, std::size_t) { view.bring_to_wall(); }}
          .for_staff(),
      LiveKey{Key::F11, "F11", Phrase::KeyFullScreen,
              [](LiveView& view, std::size_t) { view.windows_.toggle_full_screen(); }}
          .for_staff(),
      LiveKey{Key::F12, "F12", Phrase::KeySavePicture, [](LiveView& view, std::size_t) { view.picture_.save(); }}
          .for_staff(),
      LiveKey{Key::N, "N", Phrase::KeySkip, [](LiveView& view, std::size_t) { view.skip_step(); }}.in_lessons(),
      LiveKey{Key::O, "O", Phrase::KeyTryAgain, [](LiveView& view, std::size_t) { view.try_again(); }}.in_lessons(),
      LiveKey{Key::Escape, "Esc", Phrase::KeyEnd, [](LiveView& view, std::size_t) { view.leaving_ = true; }}
          .for_staff(),
      LiveKey{Key::F1, "F1", Phrase::Keys, [](LiveView& view, std::size_t) { view.panels_.toggle_keys(); }},
  };
};

std::span<const LiveKey> live_keys() { return LiveKeyTable::kRows; }

render::DataPanel key_list(HandSource hand, bool unattended, const exhibit::Phrases& phrases, WallUse use) {
  render::DataPanel panel;
  panel.title = phrases[Phrase::Keys];
  panel.subtitle = phrases[Phrase::KeysHidden];
  Phrase text_above = Phrase::Keys;
  for (const LiveKey& key : live_keys()) {
    const bool shown = key.press != nullptr || hand == HandSource::Mouse;
    if (key.text == Phrase::Keys || !shown || !key.acts(use) || (key.staff && unattended)) continue;
    const std::string name = phrases.word(key.name);
    if (key.text == text_above) {
      panel.rows.back().value += ", " + name;
      continue;
    }
    text_above = key.text;
    // without notes below them: with those the rows would stand on one another
    panel.rows.push_back({phrases[key.text], name + (key.mouse ? ", " + phrases[*key.mouse] : ""), ""});
  }
  return panel;
}

}  // namespace afm::app
