// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "physics/branch_table.h"
#include "physics/force_law.h"

namespace afm::physics {

// A branch of a law with lever and support in series, SI: at its parameter s the tip is at h and the lever's base at Z
// = h - c F, c = 1/k_c + 1/k_s. A tip can rest where Z follows the motion, inwards along a free branch and outwards
// along an attached one: until dF/dh = 1/c, where the branch folds, or until the branch ends.
class EquilibriumBranch {
 public:
  enum class Direction { Inwards, Outwards };

  struct Point {
    double z = 0.0;
    double h = 0.0;
    double force = 0.0;
    double dz_ds = 0.0;
    double dforce_ds = 0.0;
  };

  // `branch` must outlive the object.
  EquilibriumBranch(const LawBranch& branch, double compliance, Direction direction);

  Point at(double s) const;

  // End of the stable stretch that begins at the branch's first point, and whether a fold ends it.
  double end() const { return end_; }
  bool folded() const { return folded_; }

  // Ends the stretch before its fold or end.
  void cut_at(double s) { end_ = s; }

  // s of the place on the stable stretch with this Z; empty if the stretch does not reach it.
  std::optional<double> at_z(double z) const;

  // The stable stretch as a table from its end outwards over `reach` of Z, or to the end of the branch.
  BranchTable table(double reach) const;

 private:
  // Rate dZ/ds with the sign of motion: positive where the tip can rest.
  double rate(double s) const;
  double fold_between(double stable, double unstable) const;
  void find_end();
  // The table between two places without a kink in between, the first one closer to the branch's end.
  BranchTable::Piece piece(double from, double to, double end_z, double reach) const;
  double solve(double z, double guess, double low, double high, Point& solution) const;

  const LawBranch& branch_;
  double compliance_;
  double sign_;  // +1 or -1, sign of dZ/ds on the stable stretch
  double end_ = 0.0;
  bool folded_ = false;
};

// The branch in the opposite direction.
LawBranch reversed(const LawBranch& branch);

// The largest positive dF/dh of a branch: a lever of at least this stiffness does not fold it. Infinite if h turns back
// along it.
double steepest_attraction(const LawBranch& branch);

// Rise of the potential: the integral of -F dh along a branch from one parameter to another.
double potential_rise(const LawBranch& branch, double from, double to);

}  // namespace afm::physics
