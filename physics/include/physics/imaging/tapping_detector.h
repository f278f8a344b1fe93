// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "physics/tapping/tap_envelope.h"
#include "physics/units.h"

namespace afm::physics {

class AveragedFlow;
class TapSurface;
struct DrivenLever;

// What a microscope in tapping mode detects over a surface whose height changes: the swing of TapEnvelope, which the
// feedback keeps at a setpoint.
//
// One thread. Only the constructor and copies allocate.
class TappingDetector {
 public:
  // `setpoint`: amplitude that the feedback keeps. Throws UnphysicalValue unless Q is at least
  // AveragedFlow::kLeastQuality, the setpoint is within 1 % to 99.9 % of the free amplitude, and a tip that comes from
  // above finds a height with this amplitude.
  TappingDetector(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever, Length setpoint);

  // Puts the swing at rest at the setpoint, in the state that a tip from above finds first.
  void engage() noexcept { envelope_.place(engaged_.u_m, engaged_.v_m, engaged_.gap_m); }

  // Lets the swing follow for `angle`, in w0 t, with the base `gap_m` above the surface.
  void advance(double gap_m, double angle) noexcept { envelope_.advance(gap_m, gap_m, angle); }

  double amplitude_m() const noexcept { return envelope_.amplitude_m(); }
  double phase_rad() const noexcept { return envelope_.phase_rad(); }        // lag behind the drive, 0 to 2 pi
  double lost_j() const noexcept { return envelope_.lost_j(); }              // in the sample, per swing
  double peak_force_n() const noexcept { return envelope_.peak_force_n(); }  // at the lowest point of the swing

  const DrivenLever& lever() const noexcept { return envelope_.lever(); }
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
  TapEnvelope envelope_;
};

}  // namespace afm::physics
