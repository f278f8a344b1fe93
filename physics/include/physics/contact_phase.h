// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace afm::physics {

// WaitForLift: no force until the tip has been lifted above Z_joc, because below it the tip might be attached or free.
// Free: not touching. Attached: on the surface, pressed or adhering. Session files and curves contain the numbers.
enum class Phase : std::uint32_t { WaitForLift = 0, Free = 1, Attached = 2 };

// A jump from one branch of the law to the other, or sideways from one well of a lattice to the next
// (physics/friction/lattice_tip.h). Session files contain the numbers.
enum class EventKind : std::uint32_t { JumpToContact = 1, JumpOffContact = 2, Slip = 3 };

// Name in reports and replays.
constexpr const char* name_of(EventKind kind) {
  if (kind == EventKind::Slip) return "slip";
  return kind == EventKind::JumpToContact ? "jump-to-contact" : "jump-off-contact";
}

}  // namespace afm::physics
