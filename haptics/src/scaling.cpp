// SPDX-License-Identifier: Apache-2.0
#include "haptics/scaling.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace afm::haptics {

namespace {
constexpr double kKneeShare = 0.75;
}

core::Result<FitScaling> FitScaling::create(const physics::CycleFigures& figures, const DeviceSpec& device) {
  const double pull_n = force_cap_n(device);
  const double limit_n_per_m = std::min(kMaxStiffnessNPerM, device.max_stiffness_n_per_m);
  if (!(pull_n > 0) || !(pull_n / kStrokeM <= limit_n_per_m)) {
    return core::failure(
        core::ErrorCategory::DeviceMissing,
        fmt::format("cannot fit the adhesion force to the {}: it would need {:.0f} N/m, and {:.0f} N/m is "
                    "the most that stays stable",
                    device.name, pull_n / kStrokeM, limit_n_per_m));
  }
  const double above_m = device.workspace_max_m.y - device.contact_point_m.y;
  if (!(above_m > kStrokeM)) {
    return core::failure(
        core::ErrorCategory::DeviceMissing,
        fmt::format("cannot fit the stroke of {:.0f} mm to the {}: it reaches {:.0f} mm above the contact "
                    "point",
                    1e3 * kStrokeM, device.name, 1e3 * above_m));
  }
  return FitScaling(kStrokeM / figures.z_joc.si, pull_n / -figures.force_before_joc.si, pull_n);
}

double FitScaling::hand_force_n(double tip_force_n) const noexcept {
  const double linear_n = hand_n_per_n_ * tip_force_n;
  const double knee_n = kKneeShare * pull_force_n_;
  if (linear_n <= knee_n) return linear_n;
  const double rest_n = pull_force_n_ - knee_n;
  return knee_n + rest_n * std::tanh((linear_n - knee_n) / rest_n);
}

}  // namespace afm::haptics
