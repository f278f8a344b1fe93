// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace afm::render {

// Sorts draws by their distances, in a time that grows with their number, not faster. Keeps its memory for the next
// frame.
class DistanceOrder {
 public:
  void clear() { draws_.clear(); }

  // `distance`: not negative, in any unit; used with the precision of float.
  void add(double distance, std::uint32_t draw);

  // Writes the draws added since clear(), the nearest first; those at the same distance as they were added.
  void near_to_far(std::vector<std::uint32_t>& order);

 private:
  struct Placed {
    std::uint32_t key = 0;  // bits of the distance, which sort like the number
    std::uint32_t draw = 0;
  };
  void sort_by_digit(unsigned lowest_bit);

  std::vector<Placed> draws_, sorted_;
};

}  // namespace afm::render
