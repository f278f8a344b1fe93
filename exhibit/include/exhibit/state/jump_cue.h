// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// For how long a jump is shown. A CPU device draws two frames a second: shorter, and a jump might not be seen at all.
inline constexpr double kCueSeconds = 0.5;

// A jump that has just happened.
struct JumpCue {
  physics::EventKind kind = physics::EventKind::JumpToContact;
  double age_s = 0;  // 0 to kCueSeconds
};

template <class Visit, scene::RecordOf<JumpCue>... Record>
constexpr void for_each_field(Visit&& visit, Record&... cue) {
  visit("kind", cue.kind...);
  visit("age_s", cue.age_s...);
}
static_assert(scene::all_fields_described<JumpCue>());

// The jump that is shown: the newest one, but none gives way to the next before kLeastNs, so that a tip that chatters
// does not flash more than three times a second (WCAG 2.3.1). One thread.
class JumpCues {
 public:
  static constexpr std::int64_t kLeastNs = 400'000'000;

  // Every event, in the order of their times. Slips are many times a second, and not shown.
  void add(const scene::TipEvent& event);

  std::optional<JumpCue> at(std::int64_t now_ns) const;

  // When the newest one began, though it may be over: a slow frame may show nothing of it.
  std::optional<std::int64_t> begun_ns(std::int64_t now_ns) const;

 private:
  struct Shown {
    physics::EventKind kind = physics::EventKind::JumpToContact;
    std::int64_t since_ns = 0;
  };
  std::optional<Shown> begun(std::int64_t now_ns) const;

  std::optional<Shown> shown_, next_;
};

// What they show of these events, in order of time.
std::optional<JumpCue> jump_cue(std::span<const scene::TipEvent> events, std::int64_t now_ns);

// The ring of light that shows it: told apart by the way that it goes, not by its colour alone. A jump to contact
// closes in on the apex, a jump off contact spreads from it; both fade.
struct CueRing {
  glm::vec3 color{0.0F};  // linear radiance
  double radius = 0;      // in radii of the contact's shade
};
CueRing cue_ring(const JumpCue& cue);

}  // namespace afm::exhibit
