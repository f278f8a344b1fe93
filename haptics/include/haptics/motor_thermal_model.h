// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::haptics {

// Temperature of a device's motors, and the share of the force that keeps them below their rating.
//
// Models one thermal mass, heated by the square of the force (I^2 R) and cooled by the air:
//
//   dh/dt = ((F / F_continuous)^2 - h) / tau
//
// so that a continuous force at the rating settles at h = 1. A device's own measurement (HDAPI: 0 cold, 1 too hot)
// takes precedence where it is higher. Above kWarm the force decreases linearly, to kRestShare of the rating at h = 1:
// under a sustained force at the cap it settles just below the rating, without a perceptible step.
//
// tau lies between the values for small ironless DC motors, about ten seconds for the winding and about ten minutes for
// the housing, nearer to the winding, which burns first. It is an assumption: no vendor publishes it for a haptic
// device.
class MotorThermalModel {
 public:
  static constexpr double kTimeConstantS = 30.0;
  static constexpr double kWarm = 0.8;
  static constexpr double kHot = 1.0;  // heat at which the force is removed; the simulated heat never reaches it
  static constexpr double kRestShare = 0.9;

  // `continuous_force_n` is the continuous rating of the motors; if 0 (unknown), only the device's own measurement
  // counts. `cap_n` is the strongest force that can be requested.
  MotorThermalModel(double continuous_force_n, double cap_n);

  // `force_n` was applied for `elapsed_s`; `measured_heat` is the device's measurement, 0 if it has none.
  void update(double force_n, double elapsed_s, double measured_heat) noexcept;

  double heat() const noexcept;
  double gain() const noexcept;  // factor of the force, in (0, 1]

 private:
  double continuous_force_n_;
  double rest_gain_;
  double simulated_ = 0;
  double measured_ = 0;
};

}  // namespace afm::haptics
