// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "heap_contacts.h"

namespace afm::physics {

inline constexpr std::size_t kMostUnknowns = 3 + 3 * HeapContacts::kMostActive;

// Gradient and stiffness of E + R over the apex and the movers: three unknowns, then two for each sphere and three for
// each rod, the last of which is its turn.
struct HeapSystem {
  explicit HeapSystem(std::size_t unknowns) noexcept : size(unknowns) {
    for (std::size_t i = 0; i < size; ++i) std::fill_n(stiffness[i].begin(), size, 0.0);
  }

  std::size_t size;
  std::array<double, kMostUnknowns> gradient{};
  std::array<std::array<double, kMostUnknowns>, kMostUnknowns> stiffness;  // valid up to size x size
};

inline std::size_t unknowns_of(const HeapContacts::Body& body) noexcept { return body.is_rod() ? 3 : 2; }

// Part of the system from a contact or the friction of a sphere. `row` is the first row of a body; 0: it does not move.
// `curved`: with the curvature of the overlap, which may make the system indefinite.
void add_sphere_tip(HeapSystem& s, const HeapContacts& heap, std::size_t body, std::size_t row, bool curved) noexcept;
void add_sphere_pair(HeapSystem& s, const HeapContacts& heap, std::size_t pair, std::size_t row_first,
                     std::size_t row_second, bool curved) noexcept;
void add_sphere_friction(HeapSystem& s, const HeapContacts::Body& sphere, std::size_t row) noexcept;

}  // namespace afm::physics
