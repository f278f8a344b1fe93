// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "haptics/potential_energy.h"

namespace afm::haptics {

// Potential U of one branch of a force law over the height of the hand, zero at the upper end of its range, and the
// force as its exact slope, F = -dU/dh: the cubics between nodes that have the law's force and its integral. The force
// is continuous, and that of the law at every node. Outside the range the force keeps its value at the end. Built once;
// at() may be called in a tick of the servo.
class HeightPotential {
 public:
  static constexpr double kSpacingM = 1e-4;  // distance of the nodes in metres of the hand

  // `force_n` is the force on the hand along the normal. Allocates.
  HeightPotential(const PotentialEnergy::ForceOverHeight& force_n, PotentialEnergy::Range range);

  struct Value {
    double energy_j = 0;
    double force_n = 0;
  };
  Value at(double height_m) const noexcept;

 private:
  struct Node {
    double energy_j = 0;
    double force_n = 0;
  };

  double lowest_m_;
  std::vector<Node> nodes_;
};

}  // namespace afm::haptics
