// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// The most energy that a hand can get from a force law, at every height and on both branches: the potential U of the
// felt force, in joules of the hand. On each branch dU/dh = -F, up to a constant. Where the tip jumps to contact the
// branches meet, U_free(h_in) = U_attached(h_in): the most that a latch without work can hold there. And U is zero at
// its lowest place, so that U far away is E0, the free energy that one approach can give: the work of the free branch
// down to h_in and of the attached one from there to where it pulls no more. For the paper's law, on a scale that makes
// it a spring K, E0 = 1/2 K h_in^2. A force that is bent by a monotone map of itself (haptics/scaling.h) has such a
// potential like any other, because force and height are one-dimensional; over a height field it is that of the height
// above the surface.
//
// A law is passive if it jumps off contact where U_attached >= U_free: the difference is what its loop loses.
//
// Built once, with the contact model; read in a tick, which is a look-up in a table with straight lines between its
// nodes.
class PotentialEnergy {
 public:
  // Force on the hand along the normal at a height of the hand, positive away from the sample.
  using ForceOverHeight = std::function<double(double height_m)>;

  struct Range {
    double lowest_m;
    double highest_m;
  };

  // For heights within `range`; beyond, U goes on along its last line. Allocates, and takes some 0.2 ms.
  PotentialEnergy(const ForceOverHeight& free_n, const ForceOverHeight& attached_n, double jump_in_m, Range range);

  // U; zero in WaitForLift, where there is no force.
  double at(physics::Phase phase, double height_m) const noexcept;

  // E0.
  double credit_j() const noexcept { return free_j_.back(); }

  // The steepest rise of the force on the way down, of either branch where the tip can be on it; over some 0.1 mm.
  double stiffness_n_per_m() const noexcept { return stiffness_n_per_m_; }

 private:
  double lowest_m_;
  double stiffness_n_per_m_ = 0;
  std::vector<double> free_j_;
  std::vector<double> attached_j_;
};

}  // namespace afm::haptics
