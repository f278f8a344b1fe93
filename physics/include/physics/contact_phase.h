// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace afm::physics {

// WaitForLift: no force is given until the tip has been lifted above Z_joc, because below it nobody knows whether it
// sticks. Free: not touching. Attached: on the surface, pressed or adhering. Session files and curves hold the numbers.
enum class Phase : std::uint32_t { WaitForLift = 0, Free = 1, Attached = 2 };

// A jump from one branch of the law to the other, or sideways from one well of a lattice to the next
// (physics/friction/lattice_tip.h). Session files hold the numbers.
enum class EventKind : std::uint32_t { JumpToContact = 1, JumpOffContact = 2, Slip = 3 };

// As reports and replays name it.
constexpr const char* name_of(EventKind kind) {
  if (kind == EventKind::Slip) return "slip";
  return kind == EventKind::JumpToContact ? "jump-to-contact" : "jump-off-contact";
}

}  // namespace afm::physics
