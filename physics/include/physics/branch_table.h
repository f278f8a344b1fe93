// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "physics/units.h"

namespace afm::physics {

// F(Z) of one branch of the lever's force, to be looked up in O(1) without allocation by one or many threads. A branch
// lies above or below the Z at which it ends, in a jump or in contact.
//
// Near a jump F goes like the square root of the distance to it, so F is tabulated in u = sqrt(|Z - Z_end|), between
// nodes that lie the closer the nearer they are to the end, `kNodesPerOctave` for each doubling of u: what the branch
// does at any scale is met by nodes of that scale. Between two nodes F is the cubic with the nodes' values and slopes,
// so that a parabola in u, and with it a straight line in Z, is exact. Where the branch has a kink a piece of the table
// ends and another begins, with u counted from the kink. A recorded branch, which knows nothing of its fold, has nodes
// at equal distances in Z instead.
class BranchTable {
 public:
  static constexpr std::size_t kNodesPerOctave = 128;

  enum class Side { Above, Below };  // side of its end on which the branch lies

  struct Node {
    double force_n = 0.0;
    double slope = 0.0;  // dF/du, N/sqrt(m); of equally spaced nodes dF/d|Z - Z_end|, N/m
  };

  // Between two kinks. Node 0 lies at u = 0, node i at node_u(first_octave, i), but for the last, which lies at
  // `last_u`.
  struct Piece {
    double start = 0.0;  // |Z - Z_end| of its first node, m
    int first_octave = 0;
    double last_u = 0.0;
    std::vector<Node> nodes;  // at least two
  };
  static double node_u(int first_octave, std::size_t index) noexcept;

  // Zero everywhere.
  BranchTable() = default;

  // A straight line in Z everywhere.
  static BranchTable straight(Force force_at_zero, Stiffness slope);

  // `pieces` from the end outwards, at least one; the first starts at 0 and each where the one before has its last
  // node.
  BranchTable(Length end, Side side, std::vector<Piece> pieces);

  // `nodes` at |Z - Z_end| = 0, `spacing`, 2 `spacing`, ...: at least two.
  BranchTable(Length end, Side side, Length spacing, std::vector<Node> nodes);

  // Continued beyond the last node: falling to zero as the last nodes do above the end, along the last slope below it.
  // On the other side of the end it keeps the force of the end.
  Force force(Length z) const noexcept;

  Length end() const noexcept { return Length(end_z_); }

 private:
  // Beyond the last node, from how F changes there away from the end.
  void continue_from(double distance, const Node& last, double slope_outwards);
  Force force_beyond(double z, double distance) const noexcept;

  double end_z_ = 0.0;
  double side_ = 1.0;    // +1 above the end, -1 below
  double reach_ = -1.0;  // |Z - Z_end| of the last node; below zero where there are none
  double last_force_ = 0.0;
  double tail_exponent_ = 0.0;       // positive: F falls off as distance^-tail_exponent beyond the last node
  double line_force_at_zero_ = 0.0;  // otherwise F is this line there
  double line_slope_ = 0.0;          // N/m
  double spacing_ = 0.0;             // positive if the nodes are equally spaced
  std::vector<Piece> pieces_;        // a single one if the nodes are equally spaced
};

}  // namespace afm::physics
