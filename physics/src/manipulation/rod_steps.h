// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "heap_system.h"

// Parts of a heap's descent for rods. `row` is the first row of a body in the system; 0: it does not move.
namespace afm::physics {

// The contact of the tip with a rod, without the curvature of the overlap.
void add_rod_tip(HeapSystem& s, const HeapContacts& heap, std::size_t body, std::size_t row) noexcept;

// The contact of two bodies, at least one of them a rod, without the curvature of the overlap.
void add_rod_pair(HeapSystem& s, const HeapContacts& heap, std::size_t pair, std::size_t row_first,
                  std::size_t row_second) noexcept;

// Friction of a moving rod.
void add_rod_friction(HeapSystem& s, const HeapContacts::Body& rod, std::size_t row) noexcept;

// End of a step of only this rod: its first motion if it yields, afterwards a Newton step, or back to its start if
// nothing touches it. Empty if it rests.
std::optional<HeapContacts::Place> rod_step(const HeapContacts& heap, std::size_t body) noexcept;

// True if a place lies on the other side of the start of a body, where friction has a kink.
bool goes_back(const HeapContacts::Body& body, const HeapContacts::Place& to) noexcept;

// Upper limit of the way of its points from one place to another.
double way_between(const HeapContacts::Place& a, const HeapContacts::Place& b) noexcept;

}  // namespace afm::physics
