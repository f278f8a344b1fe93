// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// Largest energy that a hand can get from a force law, at every height and on both branches: the potential U of the
// felt force, in joules of the hand. On each branch dU/dh = -F, up to a constant. The branches meet at the jump to
// contact, U_free(h_in) = U_attached(h_in): the most that a latch without work can store there. U is zero at its
// minimum, so that U far away is E0, the free energy that one approach can give: the work of the free branch down to
// h_in, plus that of the attached one from there to where it stops pulling. For the paper's law, on a scale that makes
// it a spring K, E0 = 1/2 K h_in^2. A force mapped by a monotone function (haptics/scaling.h) has such a potential too,
// because force and height are one-dimensional; over a height field it depends on the height above the surface.
//
// A law is passive if it jumps off contact where U_attached >= U_free: the difference is the loss of its loop.
//
// Built once, with the contact model. In a tick it only interpolates a table linearly.
class PotentialEnergy {
 public:
  // Force on the hand along the normal at a height of the hand, positive away from the sample.
  using ForceOverHeight = std::function<double(double height_m)>;

  struct Range {
    double lowest_m;
    double highest_m;
  };

  // Tabulates U for heights within `range`; outside, U continues linearly. Allocates, and takes about 0.2 ms.
  PotentialEnergy(const ForceOverHeight& free_n, const ForceOverHeight& attached_n, double jump_in_m, Range range);

  // Potential U; zero in WaitForLift, where there is no force.
  double at(physics::Phase phase, double height_m) const noexcept;

  // Steepest rise of the force on the way down, of either branch where the tip can be on it; over about 0.1 mm.
  double stiffness_n_per_m() const noexcept { return stiffness_n_per_m_; }

 private:
  double lowest_m_;
  double stiffness_n_per_m_ = 0;
  std::vector<double> free_j_;
  std::vector<double> attached_j_;
};

}  // namespace afm::haptics
