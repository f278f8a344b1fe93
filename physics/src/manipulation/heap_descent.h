// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "heap_contacts.h"

namespace afm::physics {

// The rule that keeps the hand from gaining energy: no step raises stored energy plus friction.
bool may_be_taken(double change_j) noexcept;

// Lowers E + R of a heap from the positions at the start of a sub-step, with the apex at h >= 0; no part moves by more
// than `reach_m`. Friction separates by sphere, so that its minimum is the motion of least dissipation. A step is taken
// only if it lowers the sum.
//
// Ends when no step gains, when a part has moved by `reach_m`, or when `work` is spent: looks at contacts, a figure
// that depends only on the heap. Subtracts what was needed; a step that has begun is solved even if that is more
// than was left. Returns whether the heap came to rest.
bool descend(HeapContacts& heap, double reach_m, double& work) noexcept;

}  // namespace afm::physics
