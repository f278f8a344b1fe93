// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

class Phrases;

// Durations of a jump's display: of its word, its number and the lever as it was; and, shorter, of its ring of light. A
// CPU device draws two frames a second, so a shorter cue might never be drawn.
inline constexpr double kCueSeconds = 1.5, kRingSeconds = 1.0;

// A recent jump of the tip, or of the state in tapping mode, frozen as it was when it happened: it does not follow the
// tip.
struct JumpCue {
  physics::EventKind kind = physics::EventKind::JumpToContact;
  float force_n = 0;  // force before a jump off contact, after any other jump
  double age_s = 0;   // time since the jump, 0 to kCueSeconds
};

template <class Visit, scene::RecordOf<JumpCue>... Record>
constexpr void for_each_field(Visit&& visit, Record&... cue) {
  visit("kind", cue.kind...);
  visit("force_n", cue.force_n...);
  visit("age_s", cue.age_s...);
}
static_assert(scene::all_fields_described<JumpCue>());

// Selects the jump to show: the newest one. Each is shown for at least kLeastNs, so that a chattering tip does not
// flash more than three times a second (WCAG 2.3.1). One thread.
class JumpCues {
 public:
  static constexpr std::int64_t kLeastNs = 400'000'000;

  // Adds an event; call in order of time. Ignores slips, which occur many times a second.
  void add(const scene::TipEvent& event);

  std::optional<JumpCue> at(std::int64_t now_ns) const;

  // Time at which the newest cue began, even if it has ended: a slow frame may have missed it.
  std::optional<std::int64_t> begun_ns(std::int64_t now_ns) const;

 private:
  struct Shown {
    physics::EventKind kind = physics::EventKind::JumpToContact;
    float force_n = 0;
    std::int64_t since_ns = 0;
  };
  std::optional<Shown> begun(std::int64_t now_ns) const;

  std::optional<Shown> shown_, next_;
};

// The cue that results from these events, in order of time.
std::optional<JumpCue> jump_cue(std::span<const scene::TipEvent> events, std::int64_t now_ns);

// The ring of light for a jump, distinguished by its motion as well as its colour: for a jump to contact or into the
// repulsive state it closes in on the apex, for the way back it spreads from it. Both fade.
struct CueRing {
  glm::vec3 color{0.0F};  // linear radiance
  double radius = 0;      // radius in units of the contact's shade
};
CueRing cue_ring(const JumpCue& cue);

// Word and number of the jump: "snap-in −0.41 nN", "repulsive +0.31 nN".
std::string cue_text(const JumpCue& cue, const Phrases& phrases);

}  // namespace afm::exhibit
