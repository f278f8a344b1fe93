// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.h"
#include "haptics/device.h"
#include "physics/cycle_figures.h"

namespace afm::haptics {

// From nanometres and nanonewtons to a hand, one material at a time ("fit"): Z_joc fills a stroke of 50 mm, and F_ad is
// as strong as the device may be, at most 2.0 N. The hand then feels the same spring, F*/L = 40 N/m, whatever the
// material; what differs is where in the stroke the tip snaps in, and how hard.
//
// - The map of Z is linear, so that events keep their places.
// - The map of the force is linear for attraction and the first three quarters of repulsion, then bends so that it
// stays
//   below the cap: monotone and nowhere steeper than the linear part, so that it adds no energy and no stiffness.
class FitScaling {
 public:
  static constexpr double kStrokeM = 0.050;
  static constexpr double kMaxStiffnessNPerM = 400.0;  // stable on every device of this class at 1 kHz

  // Fails if the device would have to be stiffer than it can be, or if the stroke does not fit above its contact point.
  static core::Result<FitScaling> create(const physics::CycleFigures& figures, const DeviceSpec& device);

  double hand_m_per_m() const noexcept { return hand_m_per_m_; }
  double hand_n_per_n() const noexcept { return hand_n_per_n_; }
  double pull_force_n() const noexcept { return pull_force_n_; }  // on the hand at pull-off
  double stiffness_n_per_m() const noexcept { return pull_force_n_ / kStrokeM; }

  // Z for a hand this high above the contact point along the sample's normal.
  double z_m(double hand_height_m) const noexcept { return hand_height_m / hand_m_per_m_; }

  // The force on the hand along the sample's normal for a force on the tip; both positive away from the sample.
  double hand_force_n(double tip_force_n) const noexcept;

 private:
  FitScaling(double hand_m_per_m, double hand_n_per_n, double pull_force_n)
      : hand_m_per_m_(hand_m_per_m), hand_n_per_n_(hand_n_per_n), pull_force_n_(pull_force_n) {}

  double hand_m_per_m_;
  double hand_n_per_n_;
  double pull_force_n_;
};

}  // namespace afm::haptics
