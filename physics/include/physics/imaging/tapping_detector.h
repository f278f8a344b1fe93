// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "physics/units.h"

namespace afm::physics {

class AveragedFlow;
class TapEnvelope;
class TapSurface;
struct DrivenLever;

// Signal of a microscope in tapping mode over a surface whose height changes: the swing of TapEnvelope, which the
// feedback keeps at a setpoint.
//
// One thread. Only the constructor and copies allocate.
class TappingDetector {
 public:
  // `setpoint`: amplitude that the feedback keeps. Throws UnphysicalValue unless Q is at least
  // AveragedFlow::kLeastQuality, the setpoint is within 1 % to 99.9 % of the free amplitude, and a tip that comes from
  // above finds a height with this amplitude.
  TappingDetector(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever, Length setpoint);

  ~TappingDetector();
  TappingDetector(const TappingDetector& other);
  TappingDetector(TappingDetector&& other) noexcept;
  TappingDetector& operator=(const TappingDetector& other);
  TappingDetector& operator=(TappingDetector&& other) noexcept;

  // Puts the swing at rest at the setpoint, in the state that a tip from above finds first.
  void engage() noexcept;

  // Lets the swing follow for `angle`, in w0 t, with the base `gap_m` above the surface.
  void advance(double gap_m, double angle) noexcept;

  double amplitude_m() const noexcept;
  double phase_rad() const noexcept;     // lag behind the drive, 0 to 2 pi
  double lost_j() const noexcept;        // in the sample, per swing
  double peak_force_n() const noexcept;  // at the lowest point of the swing

  const DrivenLever& lever() const noexcept;
  double free_amplitude_m() const noexcept { return free_amplitude_m_; }
  double setpoint_m() const noexcept { return setpoint_m_; }
  double engaged_gap_m() const noexcept { return engaged_.gap_m; }  // height of the base after engage()

 private:
  // A swing at rest at the setpoint.
  struct Engaged {
    double gap_m, u_m, v_m;
  };
  Engaged find_setpoint(AveragedFlow& flow, double contact_m) const;
  TappingDetector(AveragedFlow&& flow, Length contact_height, Length setpoint);

  double free_amplitude_m_ = 0, setpoint_m_ = 0;
  Engaged engaged_;
  std::unique_ptr<TapEnvelope> envelope_;
};

}  // namespace afm::physics
