// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/view/key_list.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "render/key.h"

namespace afm::app {

class JourneyControl;
class LessonControl;
class MapControl;
class ParticlesControl;
class PlaceControl;
class ScanControl;
class SoundControl;
struct ViewParts;

// Possible receivers of a key: the parts that all controls share, or one control.
struct KeyOwners {
  ViewParts& parts;
  PlaceControl* place = nullptr;
  JourneyControl* journey = nullptr;
  LessonControl* lesson = nullptr;  // receiver of keys for lessons; null without a lesson
  ScanControl* scan = nullptr;
  SoundControl* sound = nullptr;
  MapControl* map = nullptr;
  ParticlesControl* particles = nullptr;  // receiver of keys for particles; null without particles
};

// A key of the live window, or a run of consecutive keys with the same action and a number each.
struct LiveKey {
  render::Key key;
  const char* name;      // name as in docs/manual/demonstrate.md; the wall translates it
  exhibit::Phrase text;  // text in the list of keys; neighbours with equal texts share a line; Keys: not listed
  void (*press)(KeyOwners& owners, std::size_t number);  // action; 0: the run's first key; null: key of MouseHand
  std::optional<exhibit::Phrase> mouse{};                // mouse action with the same effect
  render::Key last = key;                                // last key of the run
  bool staff = false;                                    // true: ignored in an unattended window
  bool not_in_lessons = false;  // true: ignored in lessons, because it would change or reveal the answer
  bool lessons_only = false;
  bool particles_only = false;

  // Same row, for staff only.
  constexpr LiveKey for_staff() const {
    LiveKey row = *this;
    row.staff = true;
    return row;
  }

  // Same row, outside lessons only, or in lessons only.
  constexpr LiveKey outside_lessons() const {
    LiveKey row = *this;
    row.not_in_lessons = true;
    return row;
  }
  constexpr LiveKey in_lessons() const {
    LiveKey row = *this;
    row.lessons_only = true;
    return row;
  }

  // Same row, with particles only.
  constexpr LiveKey with_particles() const {
    LiveKey row = *this;
    row.particles_only = true;
    return row;
  }
  constexpr bool acts(WallUse use) const {
    if (particles_only) return use == WallUse::Particles;
    return use == WallUse::Lesson ? !not_in_lessons : !lessons_only;
  }

  bool holds(render::Key other) const { return other >= key && other <= last; }
};

// Every key of the live window, in the order of the printed list.
std::span<const LiveKey> live_keys();

// Names of the keys that work in an unattended window, for help and manual.
std::string keys_of_visitors();

// The list of keys for the wall, without staff keys in an unattended window. Mouse keys are listed only when the mouse
// moves the hand. `letters`: labels of the keys A to Z, as render::Window::letters() returns them.
render::DataPanel key_list(HandSource hand, bool unattended, const exhibit::Phrases& phrases,
                           WallUse use = WallUse::Free, std::string_view letters = {});

}  // namespace afm::app
