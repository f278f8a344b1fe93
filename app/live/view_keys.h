// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "app/view/key_list.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "render/key.h"

namespace afm::app {

class JourneyControl;
class LessonControl;
class PlaceControl;
class ScanControl;
class SoundControl;
struct ViewParts;

// Whoever acts on a key: what all controls share, or a control.
struct KeyOwners {
  ViewParts& parts;
  PlaceControl* place = nullptr;
  JourneyControl* journey = nullptr;
  LessonControl* lesson = nullptr;  // used by rows of lessons; null without a lesson
  ScanControl* scan = nullptr;
  SoundControl* sound = nullptr;
};

// A key of the live window, or a run of keys that do the same with a number each.
struct LiveKey {
  render::Key key;
  const char* name;      // as docs/manual.md prints it; the wall translates it
  exhibit::Phrase text;  // on the list of keys; neighbours of the same text share a line; Keys: not listed
  void (*press)(KeyOwners& owners, std::size_t number);  // 0 for the run's first key; null: MouseHand follows the key
  std::optional<exhibit::Phrase> mouse{};                // does the same
  render::Key last = key;                                // of the run
  bool staff = false;                                    // does nothing in an unattended window
  bool not_in_lessons = false;                           // would change what a lesson asks, or give it away
  bool lessons_only = false;

  // The same row, for staff alone.
  constexpr LiveKey for_staff() const {
    LiveKey row = *this;
    row.staff = true;
    return row;
  }

  // The same row, without effect in a lesson; and in a lesson alone.
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
  constexpr bool acts(WallUse use) const { return use == WallUse::Lesson ? !not_in_lessons : !lessons_only; }

  bool holds(render::Key other) const { return other >= key && other <= last; }
};

// Every key of the live window, in the order of the list.
std::span<const LiveKey> live_keys();

// The list of keys for the wall, without those of staff where nobody attends. Those of MouseHand stand there where the
// mouse moves the hand.
render::DataPanel key_list(HandSource hand, bool unattended, const exhibit::Phrases& phrases,
                           WallUse use = WallUse::Free);

}  // namespace afm::app
