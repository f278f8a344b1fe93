// SPDX-License-Identifier: Apache-2.0
#include "app/live/view_keys.h"

#include <array>
#include <string>

#include "app/display/view_picture.h"
#include "app/display/view_windows.h"
#include "app/lesson/lesson_control.h"
#include "app/live/journey_control.h"
#include "app/live/map_control.h"
#include "app/live/particles_control.h"
#include "app/live/place_control.h"
#include "app/live/scan_control.h"
#include "app/live/sound_control.h"
#include "app/view/mouse_hand.h"
#include "app/view/view_choice.h"
#include "app/view/view_controls.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "exhibit/words/phrases.h"
#include "scene/shared/push_values.h"

namespace afm::app {

namespace {

using exhibit::Phrase;
using render::Key;

constexpr double kEyeStepM = 1e-3;
constexpr double kHeadStepM = 0.05;

constexpr std::array kRows{
    LiveKey{Key::Digit1, "1 to 9", Phrase::KeyChoose,
            [](KeyOwners& owners, std::size_t number) { owners.parts.choice.number(number); }, Phrase::LeftClick,
            Key::Digit9},
    LiveKey{MouseHand::kGripKey, "Space", Phrase::KeyHand, nullptr, Phrase::RightDragOrWheel},
    LiveKey{MouseHand::kOverKey, "Z", Phrase::KeyHandOver, nullptr},
    LiveKey{MouseHand::kTurnOnKey, "T", Phrase::KeyTurnOn, nullptr, Phrase::MiddleClick},
    LiveKey{Key::Enter, "Enter", Phrase::KeyStop, [](KeyOwners& owners, std::size_t) { owners.parts.choice.enter(); }},
    LiveKey{Key::F2, "F2", Phrase::KeyParameters,
            [](KeyOwners& owners, std::size_t) { owners.parts.panels.toggle_parameters(); }}
        .outside_lessons(),
    LiveKey{Key::F3, "F3", Phrase::KeySources,
            [](KeyOwners& owners, std::size_t) { owners.parts.panels.toggle_sources(); }}
        .outside_lessons(),
    LiveKey{Key::I, "I", Phrase::KeyScan, [](KeyOwners& owners, std::size_t) { owners.scan->toggle(); }}
        .outside_lessons(),
    LiveKey{Key::U, "U", Phrase::KeyTruth, [](KeyOwners& owners, std::size_t) { owners.scan->toggle_truth(); }}
        .outside_lessons(),
    LiveKey{Key::E, "E", Phrase::KeyFalseColours, [](KeyOwners& owners, std::size_t) { owners.scan->toggle_colours(); }}
        .outside_lessons(),
    LiveKey{Key::F4, "F4", Phrase::KeyMapPicture,
            [](KeyOwners& owners, std::size_t) { owners.parts.panels.next_map_picture(); }}
        .outside_lessons(),
    LiveKey{Key::F10, "F10", Phrase::KeyMapVolume, [](KeyOwners& owners, std::size_t) { owners.map->next_volume(); }}
        .outside_lessons(),
    LiveKey{Key::F, "F", Phrase::KeyFriction,
            [](KeyOwners& owners, std::size_t) { owners.parts.choice.toggle_friction_loop(); }}
        .outside_lessons(),
    LiveKey{Key::F6, "F6", Phrase::KeyStroboscope,
            [](KeyOwners& owners, std::size_t) { owners.place->toggle_stroboscope(); }}
        .outside_lessons(),
    LiveKey{Key::L, "L", Phrase::KeyScanHand, [](KeyOwners& owners, std::size_t) { owners.scan->next_hand(); }}
        .outside_lessons(),
    LiveKey{Key::K, "K", Phrase::KeyScanFeedback,
            [](KeyOwners& owners, std::size_t) { owners.scan->toggle_feedback(); }}
        .outside_lessons(),
    LiveKey{Key::Tab, "Tab", Phrase::KeyNextSetting,
            [](KeyOwners& owners, std::size_t) { owners.parts.choice.mark_next_setting(); }}
        .outside_lessons(),
    LiveKey{Key::Plus, "+", Phrase::KeyChangeSetting,
            [](KeyOwners& owners, std::size_t) { owners.parts.choice.step_setting(1); }},
    LiveKey{Key::Minus, "-", Phrase::KeyChangeSetting,
            [](KeyOwners& owners, std::size_t) { owners.parts.choice.step_setting(-1); }},
    LiveKey{Key::M, "M", Phrase::KeyScale, [](KeyOwners& owners, std::size_t) { owners.parts.choice.next_scale(); }}
        .outside_lessons()
        .for_staff(),
    LiveKey{Key::J, "J", Phrase::KeyJourney, [](KeyOwners& owners, std::size_t) { owners.journey->turn_round(); }}
        .outside_lessons(),
    LiveKey{Key::A, "A", Phrase::KeyAnalogy, [](KeyOwners& owners, std::size_t) { owners.journey->toggle_analogy(); }}
        .outside_lessons(),
    LiveKey{Key::Y, "Y", Phrase::KeySay, [](KeyOwners& owners, std::size_t) { owners.sound->say_state(); }},
    LiveKey{Key::Q, "Q", Phrase::KeySound, [](KeyOwners& owners, std::size_t) { owners.sound->toggle_sound(); }}
        .for_staff(),
    LiveKey{Key::X, "X", Phrase::KeyBlank, [](KeyOwners& owners, std::size_t) { owners.sound->toggle_picture(); }}
        .for_staff(),
    LiveKey{Key::R, "R", Phrase::KeyStartAgain,
            [](KeyOwners& owners, std::size_t) { owners.parts.controls.begin_again(); }},
    LiveKey{Key::H, "H", Phrase::KeyHome, [](KeyOwners& owners, std::size_t) { owners.place->bring_home(); }},
    LiveKey{Key::Backspace, "Backspace", Phrase::KeyTakeBack,
            [](KeyOwners& owners, std::size_t) { owners.particles->take_back(); }}
        .with_particles(),
    LiveKey{Key::W, "W", Phrase::KeyPlan,
            [](KeyOwners& owners, std::size_t) { owners.particles->plan_next_particle(); }, Phrase::LeftClick}
        .with_particles(),
    LiveKey{Key::D, "D", Phrase::KeyPlan, [](KeyOwners& owners, std::size_t) { owners.particles->plan_next_place(); }}
        .with_particles(),
    LiveKey{Key::F9, "F9", Phrase::KeyGroove, [](KeyOwners& owners, std::size_t) { owners.particles->toggle_groove(); }}
        .with_particles(),
    LiveKey{Key::F5, "F5", Phrase::KeyLook, [](KeyOwners& owners, std::size_t) { owners.particles->look_again(); }}
        .with_particles(),
    LiveKey{Key::End, "End", Phrase::KeyLookLoad,
            [](KeyOwners& owners, std::size_t) { owners.particles->next_look_load(); }}
        .with_particles(),
    LiveKey{Key::Digit0, "0", Phrase::KeyTool,
            [](KeyOwners& owners, std::size_t) { owners.particles->choose_next(scene::PushSetting::Tool); }}
        .with_particles(),
    LiveKey{Key::Insert, "Insert", Phrase::KeySettings,
            [](KeyOwners& owners, std::size_t) { owners.particles->mark_next_setting(); }}
        .with_particles(),
    LiveKey{Key::Delete, "Delete", Phrase::KeySettings,
            [](KeyOwners& owners, std::size_t) { owners.particles->change_marked_setting(); }}
        .with_particles(),
    LiveKey{Key::Left, "Left", Phrase::KeyHeadAcross,
            [](KeyOwners& owners, std::size_t) { owners.place->move_head(-kHeadStepM, 0.0, 0.0); }}
        .for_staff(),
    LiveKey{Key::Right, "Right", Phrase::KeyHeadAcross,
            [](KeyOwners& owners, std::size_t) { owners.place->move_head(kHeadStepM, 0.0, 0.0); }}
        .for_staff(),
    LiveKey{Key::Up, "Up", Phrase::KeyHeadHeight,
            [](KeyOwners& owners, std::size_t) { owners.place->move_head(0.0, kHeadStepM, 0.0); }}
        .for_staff(),
    LiveKey{Key::Down, "Down", Phrase::KeyHeadHeight,
            [](KeyOwners& owners, std::size_t) { owners.place->move_head(0.0, -kHeadStepM, 0.0); }}
        .for_staff(),
    LiveKey{Key::PageUp, "PgUp", Phrase::KeyHeadDistance,
            [](KeyOwners& owners, std::size_t) { owners.place->move_head(0.0, 0.0, kHeadStepM); }}
        .for_staff(),
    LiveKey{Key::PageDown, "PgDn", Phrase::KeyHeadDistance,
            [](KeyOwners& owners, std::size_t) { owners.place->move_head(0.0, 0.0, -kHeadStepM); }}
        .for_staff(),
    LiveKey{Key::P, "P", Phrase::KeyPanels, [](KeyOwners& owners, std::size_t) { owners.parts.panels.toggle_all(); }}
        .outside_lessons()
        .for_staff(),
    LiveKey{Key::S, "S", Phrase::KeySwapEyes, [](KeyOwners& owners, std::size_t) { owners.parts.picture.swap_eyes(); }}
        .for_staff(),
    LiveKey{Key::V, "V", Phrase::KeyStereoMode,
            [](KeyOwners& owners, std::size_t) { owners.parts.picture.change_mode(ViewPicture::Step::Next); }}
        .for_staff(),
    LiveKey{Key::C, "C", Phrase::KeyStereoMode,
            [](KeyOwners& owners, std::size_t) { owners.parts.picture.change_mode(ViewPicture::Step::Previous); }}
        .for_staff(),
    LiveKey{Key::F7, "F7", Phrase::KeyEyeDistance,
            [](KeyOwners& owners, std::size_t) { owners.parts.picture.widen_eyes(-kEyeStepM); }}
        .for_staff(),
    LiveKey{Key::F8, "F8", Phrase::KeyEyeDistance,
            [](KeyOwners& owners, std::size_t) { owners.parts.picture.widen_eyes(kEyeStepM); }}
        .for_staff(),
    LiveKey{Key::G, "G", Phrase::KeyTestPattern,
            [](KeyOwners& owners, std::size_t) { owners.parts.picture.toggle_calibration(); }}
        .for_staff(),
    LiveKey{Key::B, "B", Phrase::KeyContactToWall,
            [](KeyOwners& owners, std::size_t) { owners.place->bring_to_wall(); }}
        .for_staff(),
    LiveKey{Key::F11, "F11", Phrase::KeyFullScreen,
            [](KeyOwners& owners, std::size_t) { owners.parts.windows.toggle_full_screen(); }}
        .for_staff(),
    LiveKey{Key::F12, "F12", Phrase::KeySavePicture,
            [](KeyOwners& owners, std::size_t) { owners.parts.picture.save(); }}
        .for_staff(),
    LiveKey{Key::N, "N", Phrase::KeySkip, [](KeyOwners& owners, std::size_t) { owners.lesson->skip(); }}.in_lessons(),
    LiveKey{Key::O, "O", Phrase::KeyTryAgain, [](KeyOwners& owners, std::size_t) { owners.lesson->try_again(); }}
        .in_lessons(),
    LiveKey{Key::Escape, "Esc", Phrase::KeyEnd,
            [](KeyOwners& owners, std::size_t) { owners.parts.turn.leaving = true; }}
        .for_staff(),
    LiveKey{Key::F1, "F1", Phrase::Keys, [](KeyOwners& owners, std::size_t) { owners.parts.panels.toggle_keys(); }},
};

// Character number `number` of a text in UTF-8.
std::string character(std::string_view text, std::size_t number) {
  const auto begins = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; };
  std::string found;
  std::size_t characters = 0;
  for (const char byte : text) {
    if (begins(byte)) ++characters;
    if (characters == number + 1) found += byte;
  }
  return found;
}

// Name of a key on the wall: for a letter, the label of its key.
std::string shown_name(const LiveKey& key, const exhibit::Phrases& phrases, std::string_view letters) {
  if (key.key < Key::A || key.key > Key::Z || letters.empty()) return phrases.word(key.name);
  return character(letters, static_cast<std::size_t>(key.key) - static_cast<std::size_t>(Key::A));
}

}  // namespace

std::span<const LiveKey> live_keys() { return kRows; }

std::string keys_of_visitors() {
  std::string names;
  for (const LiveKey& key : live_keys()) {
    if (!key.staff && key.acts(WallUse::Free)) names += (names.empty() ? "" : ", ") + std::string(key.name);
  }
  return names;
}

render::DataPanel key_list(HandSource hand, bool unattended, const exhibit::Phrases& phrases, WallUse use,
                           std::string_view letters) {
  render::DataPanel panel;
  panel.title = phrases[Phrase::Keys];
  panel.subtitle = phrases[Phrase::KeysHidden];
  Phrase text_above = Phrase::Keys;
  const auto add = [&](const LiveKey& key) {
    const bool shown = key.press != nullptr || hand == HandSource::Mouse;
    if (key.text == Phrase::Keys || !shown || !key.acts(use)) return;
    const std::string name = shown_name(key, phrases, letters);
    if (key.text == text_above) {
      panel.rows.back().value += ", " + name;
      return;
    }
    text_above = key.text;
    // without notes, which would make the rows overlap
    panel.rows.push_back({phrases[key.text], name + (key.mouse ? ", " + phrases[*key.mouse] : ""), ""});
  };
  // visitors' keys first
  for (const bool staff : {false, true}) {
    for (const LiveKey& key : live_keys()) {
      if (key.staff == staff && !(staff && unattended)) add(key);
    }
  }
  return panel;
}

}  // namespace afm::app
