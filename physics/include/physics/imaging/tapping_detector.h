// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "physics/tapping/driven_lever.h"
#include "physics/units.h"

namespace afm::physics {

class AveragedFlow;
class TapEnvelope;
class TapSurface;
class TapTable;

// Signal of a microscope in tapping mode over a surface whose height changes: the swing of TapEnvelope, which the
// feedback keeps at a setpoint. Below a quality factor of AveragedFlow::kLeastQuality it is that of a TapTable.
//
// One thread. Only the constructor and copies allocate.
class TappingDetector {
 public:
  // `setpoint`: amplitude that the feedback keeps. Throws UnphysicalValue unless the setpoint is within 1 % to 99.9 %
  // of the free amplitude, and a tip that comes from above finds a height with this amplitude. `rests`: a table of this
  // surface and lever, if one is at hand.
  TappingDetector(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever, Length setpoint,
                  std::shared_ptr<const TapTable> rests = nullptr);

  ~TappingDetector();
  TappingDetector(const TappingDetector& other);
  TappingDetector(TappingDetector&& other) noexcept;
  TappingDetector& operator=(const TappingDetector& other);
  TappingDetector& operator=(TappingDetector&& other) noexcept;

  // Puts the swing at rest at the setpoint, in the state that a tip from above finds first.
  void engage() noexcept;

  // Keeps another amplitude from now on; the swing goes on. Takes some milliseconds, and allocates. Throws as the
  // constructor does, without any change.
  void hold(Length setpoint);

  // Changes the drive of this lever, by averages alone: its free amplitude at most 1.2 times that of the
  // constructor. Throws UnphysicalValue below the least quality factor of the averages, too.
  void drive(const DrivenLever& lever, Length setpoint);

  // Lets the swing follow for `angle`, in w0 t, with the base `gap_m` above the surface.
  void advance(double gap_m, double angle) noexcept;

  double amplitude_m() const noexcept;
  double phase_rad() const noexcept;     // lag of the swing behind the drive, 0 to 2 pi
  double lost_j() const noexcept;        // energy lost in the sample per swing
  double peak_force_n() const noexcept;  // force at the lowest point of the swing

  const DrivenLever& lever() const noexcept { return lever_; }
  bool is_direct() const noexcept { return rests_ != nullptr; }  // true: swings are integrated directly, not averaged
  double free_amplitude_m() const noexcept { return lever_.free_amplitude.si; }
  double setpoint_m() const noexcept { return setpoint_m_; }
  double engaged_gap_m() const noexcept { return engaged_.gap_m; }  // height of the base after engage()

 private:
  // A swing at rest at the setpoint.
  struct Engaged {
    double gap_m = 0, u_m = 0, v_m = 0;
  };
  Engaged find_setpoint(Length setpoint) const;
  AveragedFlow averaged_flow() const;

  std::shared_ptr<const TapSurface> surface_;
  DrivenLever lever_;
  std::shared_ptr<const TapTable> rests_;  // table of resting swings; null for a high quality factor

  double setpoint_m_ = 0;
  Engaged engaged_;
  std::unique_ptr<TapEnvelope> envelope_;
};

}  // namespace afm::physics
