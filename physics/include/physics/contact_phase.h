// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace afm::physics {

// WaitForLift: no force is given until the tip has been lifted above Z_joc, because below it nobody knows whether it
// sticks. Free: not touching. Attached: on the surface, pressed or adhering. Session files and curves hold the numbers.
enum class Phase : std::uint32_t { WaitForLift = 0, Free = 1, Attached = 2 };

// A jump from one branch of the law to the other. Session files hold the numbers.
enum class EventKind : std::uint32_t { JumpToContact = 1, JumpOffContact = 2 };

}  // namespace afm::physics
