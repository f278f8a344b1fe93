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

// The newest of the events, which stand in the order of their times, if it is young enough at `now_ns`.
std::optional<JumpCue> jump_cue(std::span<const scene::TipEvent> events, std::int64_t now_ns);

// The ring of light that shows it: told apart by the way that it goes, not by its colour alone. A jump to contact
// closes in on the apex, a jump off contact spreads from it; both fade.
struct CueRing {
  glm::vec3 color{0.0F};  // linear radiance
  double radius = 0;      // in radii of the contact's shade
};
CueRing cue_ring(const JumpCue& cue);

}  // namespace afm::exhibit
