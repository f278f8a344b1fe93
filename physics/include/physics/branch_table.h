// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "physics/units.h"

namespace afm::physics {

// F(Z) of one branch of the lever's force, for lookups in O(1) without allocation, from any thread. A branch is above
// or below the Z at which it ends, in a jump or in contact.
//
// Near a jump F varies like the square root of the distance to it, so F is tabulated in u = sqrt(|Z - Z_end|). The
// nodes get denser towards the end, `kNodesPerOctave` for each doubling of u, so that every scale is resolved. Between
// two nodes F is the cubic with the nodes' values and slopes, which is exact for a parabola in u, and thus for a
// straight line in Z. At a kink of the branch one piece of the table ends and another begins, with u counted from the
// kink. A recorded branch, whose fold is unknown, has nodes at equal distances in Z instead.
class BranchTable {
 public:
  static constexpr std::size_t kNodesPerOctave = 128;

  enum class Side { Above, Below };  // side of the branch's end on which its points are

  struct Node {
    double force_n = 0.0;
    double slope = 0.0;  // dF/du, N/sqrt(m); for equally spaced nodes dF/d|Z - Z_end|, N/m
  };

  // Part between two kinks. Node 0 is at u = 0, node i at node_u(first_octave, i), except that the last is at `last_u`.
  struct Piece {
    double start = 0.0;  // |Z - Z_end| of the first node, m
    int first_octave = 0;
    double last_u = 0.0;
    std::vector<Node> nodes;  // at least two nodes
  };
  static double node_u(int first_octave, std::size_t index) noexcept;

  // Zero everywhere.
  BranchTable() = default;

  // A straight line in Z.
  static BranchTable straight(Force force_at_zero, Stiffness slope);

  // `pieces` from the end outwards, at least one. The first starts at 0, each other at the last node of the previous
  // one.
  BranchTable(Length end, Side side, std::vector<Piece> pieces);

  // `nodes` at |Z - Z_end| = 0, `spacing`, 2 `spacing`, ...; at least two.
  BranchTable(Length end, Side side, Length spacing, std::vector<Node> nodes);

  // Extrapolates beyond the last node: above the end F falls to zero like the last nodes, below it F continues with the
  // last slope. On the other side of the end it keeps the end's force.
  Force force(Length z) const noexcept;

  Length end() const noexcept { return Length(end_z_); }

 private:
  // Prepares the extrapolation beyond the last node from the outward change of F.
  void continue_from(double distance, const Node& last, double slope_outwards);
  Force force_beyond(double z, double distance) const noexcept;

  double end_z_ = 0.0;
  double side_ = 1.0;    // +1: the branch is above its end; -1: below
  double reach_ = -1.0;  // |Z - Z_end| of the last node; negative without nodes
  double last_force_ = 0.0;
  double tail_exponent_ = 0.0;       // exponent p of a tail like distance^-p beyond the last node; 0: a line
  double line_force_at_zero_ = 0.0;  // force at Z = 0 of the straight line beyond the last node, N
  double line_slope_ = 0.0;          // slope of that line, N/m
  double spacing_ = 0.0;             // distance of equally spaced nodes, m; 0: nodes spaced by octaves
  std::vector<Piece> pieces_;        // pieces from the end outwards; only one if the nodes are equally spaced
};

}  // namespace afm::physics
