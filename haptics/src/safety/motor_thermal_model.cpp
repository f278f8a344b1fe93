// SPDX-License-Identifier: Apache-2.0
#include "haptics/motor_thermal_model.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace afm::haptics {

MotorThermalModel::MotorThermalModel(double continuous_force_n, double cap_n)
    : continuous_force_n_(continuous_force_n) {
  AFM_CHECK(continuous_force_n >= 0 && cap_n > 0);
  // a hot device with unknown rating gets half the force
  rest_gain_ = continuous_force_n > 0 ? std::min(1.0, kRestShare * continuous_force_n / cap_n) : 0.5;
}

void MotorThermalModel::update(double force_n, double elapsed_s, double measured_heat) noexcept {
  // NaN is not a measurement
  measured_ = measured_heat > 0 ? std::min(measured_heat, kHot) : 0.0;
  if (continuous_force_n_ <= 0 || !(elapsed_s > 0)) return;
  const double share = force_n / continuous_force_n_;
  simulated_ -= std::expm1(-elapsed_s / kTimeConstantS) * (share * share - simulated_);
}

double MotorThermalModel::heat() const noexcept { return std::max(simulated_, measured_); }

double MotorThermalModel::gain() const noexcept {
  const double over = std::clamp((heat() - kWarm) / (kHot - kWarm), 0.0, 1.0);
  return 1.0 - over * (1.0 - rest_gain_);
}

}  // namespace afm::haptics
