// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "physics/units.h"

namespace afm::physics {

class AveragedFlow;
class TapSurface;
struct DrivenLever;

// What a microscope in tapping mode detects over a surface whose height changes: the averaged flow of AveragedFlow in
// the variables u = A cos(phi), v = A sin(phi), time in 1/w0:
//
//   u' = -g u - w v,   v' = -g v + w u + a/2r,   g = 1/2Q + E/(2 pi k r A^2),   w = (r^2 - 1)/2r + V/(r k A^2)
//
// V and E come from a table over amplitude and gap, which the constructor builds. At rest the amplitude is that of
// AveragedFlow within 0.2 %.
//
// One thread. Only the constructor and copies allocate.
class TappingDetector {
 public:
  // `setpoint`: amplitude that the feedback keeps. Throws UnphysicalValue unless Q is at least
  // AveragedFlow::kLeastQuality, the setpoint is within 1 % to 99.9 % of the free amplitude, and a tip that comes from
  // above finds a height with this amplitude.
  TappingDetector(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever, Length setpoint);

  // Puts the swing at rest at the setpoint, in the state that a tip from above finds first.
  void engage() noexcept {
    u_ = engaged_u_, v_ = engaged_v_;
    contact_ = sample(setpoint_m_, engaged_gap_m_);
  }

  // Lets the swing follow for `angle`, in w0 t, with the base `gap_m` above the surface.
  void advance(double gap_m, double angle) noexcept;

  double amplitude_m() const noexcept;
  double phase_rad() const noexcept;                              // lag behind the drive, 0 to 2 pi
  double lost_j() const noexcept { return contact_.lost; }        // in the sample, per swing
  double peak_force_n() const noexcept { return contact_.peak; }  // at the lowest point of the swing

  const DrivenLever& lever() const noexcept { return *lever_; }
  double free_amplitude_m() const noexcept { return free_amplitude_m_; }
  double setpoint_m() const noexcept { return setpoint_m_; }
  double engaged_gap_m() const noexcept { return engaged_gap_m_; }  // height of the base after engage()

 private:
  // Of one swing: virial and energy over sqrt(A), whose changes with A are then slow.
  struct Node {
    double virial = 0, lost = 0, peak = 0;
  };
  void build_table(AveragedFlow& flow);
  void find_setpoint(AveragedFlow& flow);
  Node sample(double amplitude_m, double gap_m) const noexcept;

  std::shared_ptr<const DrivenLever> lever_;
  double free_amplitude_m_ = 0, setpoint_m_ = 0, contact_m_ = 0;
  double least_amplitude_m_ = 0, amplitude_step_m_ = 0, least_x_ = 0;
  std::size_t columns_ = 0;
  std::shared_ptr<const std::vector<Node>> table_;
  double engaged_gap_m_ = 0, engaged_u_ = 0, engaged_v_ = 0;
  double u_ = 0, v_ = 0;
  Node contact_;  // newest swing
};

}  // namespace afm::physics
