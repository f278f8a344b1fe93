// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/units.h"

namespace afm::physics {

// F(Z) of one branch of the lever's force, to be looked up in O(1) without allocation by one or many threads. A branch
// lies above or below the Z at which it ends, in a jump or in contact.
//
// Near a jump F goes like the square root of the distance to it, so F is tabulated in u = sqrt(|Z - Z_end|), between
// nodes that lie the closer the nearer they are to the end, `kNodesPerOctave` for each doubling of u: what the branch
// does at any scale is met by nodes of that scale. Between two nodes F is the cubic with the nodes' values and slopes,
// so that a parabola in u, and with it a straight line in Z, is exact.
class BranchTable {
 public:
  static constexpr std::size_t kNodesPerOctave = 64;

  enum class Side { Above, Below };  // of its end, where the branch lies

  struct Node {
    double force_n = 0.0;
    double slope = 0.0;  // dF/du, N/sqrt(m)
  };

  // Zero everywhere.
  BranchTable() = default;

  // A straight line in Z everywhere.
  static BranchTable straight(Force force_at_zero, Stiffness slope);

  // u of node `index` of a branch whose node 1 lies at 2^`first_octave`; node 0 lies at the end of the branch, u = 0.
  static double node_u(int first_octave, std::size_t index) noexcept;

  // `nodes` at node_u(first_octave, 0), 1, 2, ...: at least three.
  BranchTable(Length end, Side side, int first_octave, std::vector<Node> nodes);

  // Continued beyond the last node: falling to zero as the last nodes do above the end, along the last slope below it.
  // On the other side of the end it keeps the force of the end.
  Force force(Length z) const noexcept;

  Length end() const noexcept { return Length(end_z_); }

 private:
  Force force_beyond(double z, double distance) const noexcept;

  double end_z_ = 0.0;
  double side_ = 1.0;                    // +1 above the end, -1 below
  double reach_ = -1.0;                  // |Z - Z_end| of the last node; below zero where there are none
  double tail_exponent_ = 0.0;           // above zero: F falls off as distance^-tail_exponent beyond the last node
  double line_force_at_zero_ = 0.0;      // otherwise F is this line there
  double line_slope_ = 0.0;              // N/m
  std::uint64_t first_octave_bits_ = 0;  // of node 1
  std::vector<Node> nodes_;
};

}  // namespace afm::physics
