// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::haptics {

// Temperature of a device's motors, and the share of the force that keeps them below their rating.
//
// The heat is that of one thermal mass, which a force warms by its square (I^2 R) and the air cools:
//
//   dh/dt = ((F / F_continuous)^2 - h) / tau
//
// so that a continuous force at the rating settles at h = 1. A device that measures its motors (HDAPI: 0 cold, 1 too
// hot) is believed where it says more. Above kWarm the force falls in a straight line, to kRestShare of the rating at h
// = 1: a person who holds the cap settles just below the rating, along a slope that nobody feels as a step.
//
// tau lies between the values for small ironless DC motors, about ten seconds for the winding and about ten minutes for
// the housing, nearer to the winding, which burns first. It is an assumption: no vendor publishes it for a haptic
// device.
class MotorThermalModel {
 public:
  static constexpr double kTimeConstantS = 30.0;
  static constexpr double kWarm = 0.8;
  static constexpr double kHot = 1.0;  // the force is removed; the simulated heat alone never gets there
  static constexpr double kRestShare = 0.9;

  // `continuous_force_n`: continuous rating of the motors; 0 if unknown, then only the device's own measurement counts.
  // `cap_n`: the strongest force that can be wanted.
  MotorThermalModel(double continuous_force_n, double cap_n);

  // `force_n` was on the motors for `elapsed_s`; `measured_heat` is the device's, 0 if it has none.
  void update(double force_n, double elapsed_s, double measured_heat) noexcept;

  double heat() const noexcept;
  double gain() const noexcept;  // in (0, 1]

 private:
  double continuous_force_n_;
  double rest_gain_;
  double simulated_ = 0;
  double measured_ = 0;
};

}  // namespace afm::haptics
