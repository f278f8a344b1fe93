// SPDX-License-Identifier: Apache-2.0
#include "haptics/scaling.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace afm::haptics {

namespace {

constexpr double kKneeShare = 0.75;
constexpr double kPushShareOfRadius = 0.1;

// What a hand at 50 mm/s passes in a tick: over less than that, the slope of a curve is not felt.
constexpr double kHandStepM = 50e-6;

auto refusal(std::string message) { return core::failure(core::ErrorCategory::Failed, std::move(message)); }

using Branch = physics::BranchTable;

double force_n(const Branch& branch, double z_m) { return branch.force(physics::Length(z_m)).si; }

// Where the attraction before contact falls below this magnitude, from Z_jtc upwards.
double faint_above_m(const physics::LawTables& tables, double faint_n) {
  const auto faint = [&](double z_m) { return !(force_n(tables.free, z_m) < -faint_n); };
  double near_m = tables.figures.z_jtc.si;
  if (faint(near_m)) return near_m;
  double far_m = std::max(near_m, tables.interaction.atomic_distance.si);
  while (!faint(far_m)) far_m *= 2.0;
  while (far_m - near_m > 1e-6 * far_m) {
    const double middle_m = 0.5 * (near_m + far_m);
    (faint(middle_m) ? far_m : near_m) = middle_m;
  }
  return far_m;
}

// The steepest rise of the hand's force on its way down a branch, between two heights of the hand.
double steepest_n_per_m(const FitScaling& scaling, const Branch& branch, double lowest_m, double highest_m) {
  double steepest = 0.0;
  double above_n = scaling.hand_force_n(force_n(branch, scaling.z_m(highest_m)));
  for (double height_m = highest_m - kHandStepM; height_m >= lowest_m; height_m -= kHandStepM) {
    const double here_n = scaling.hand_force_n(force_n(branch, scaling.z_m(height_m)));
    steepest = std::max(steepest, (here_n - above_n) / kHandStepM);
    above_n = here_n;
  }
  return steepest;
}

// The same on both branches, where they can be felt in the device's workspace.
double steepest_n_per_m(const FitScaling& scaling, const physics::LawTables& tables, const DeviceSpec& device) {
  const double lowest_m = device.workspace_min_m.y - device.contact_point_m.y;
  const double highest_m = device.workspace_max_m.y - device.contact_point_m.y;
  const double jump_in_m = tables.figures.z_jtc.si * scaling.hand_m_per_m();
  const double jump_off_m = tables.figures.z_joc.si * scaling.hand_m_per_m();
  return std::max(steepest_n_per_m(scaling, tables.free, std::clamp(jump_in_m, lowest_m, highest_m), highest_m),
                  steepest_n_per_m(scaling, tables.attached, lowest_m, std::clamp(jump_off_m, lowest_m, highest_m)));
}

}  // namespace

double strongest_pull_n(const physics::LawTables& tables) {
  const physics::CycleFigures& figures = tables.figures;
  double strongest_n = std::max({0.0, -figures.force_before_joc.si, -figures.force_before_jtc.si});
  const double nearest_m = 1e-4 * tables.interaction.atomic_distance.si;
  const double farthest_m = std::max(std::abs(figures.z_joc.si), tables.interaction.tip_radius.si);
  for (double distance_m = nearest_m; distance_m < farthest_m; distance_m *= 1.02) {
    strongest_n = std::max({strongest_n, -force_n(tables.attached, figures.z_joc.si - distance_m),
                            -force_n(tables.free, figures.z_jtc.si + distance_m)});
  }
  return strongest_n;
}

core::Result<FitScaling> FitScaling::create(const physics::LawTables& tables, const DeviceSpec& device) {
  const double cap_n = force_cap_n(device);
  if (!(cap_n >= kFaintestPullN)) {
    return core::failure(
        core::ErrorCategory::DeviceMissing,
        fmt::format("the {} gives {:.2g} N at most, too little to feel; use a stronger device", device.name, cap_n));
  }
  const double above_m = device.workspace_max_m.y - device.contact_point_m.y;
  if (!(above_m > kStrokeM)) {
    return core::failure(
        core::ErrorCategory::DeviceMissing,
        fmt::format("cannot fit the stroke of {:.0f} mm to the {}: it reaches {:.0f} mm above the contact point",
                    1e3 * kStrokeM, device.name, 1e3 * above_m));
  }

  const double pull_n = strongest_pull_n(tables);
  const bool pulls = pull_n > 0.0;
  const double push_m = kPushShareOfRadius * tables.interaction.tip_radius.si;
  const double reach_m = std::max(tables.figures.z_joc.si, faint_above_m(tables, kFaintShare * pull_n));
  const double reference_n = pulls ? pull_n : force_n(tables.attached, -push_m) / kKneeShare;
  FitScaling scaling(pulls ? kStrokeM / reach_m : kPushM / push_m, cap_n / reference_n, cap_n);
  if (!(scaling.hand_m_per_m_ > 0.0 && std::isfinite(scaling.hand_m_per_m_) && scaling.hand_n_per_n_ > 0.0 &&
        std::isfinite(scaling.hand_n_per_n_))) {
    return refusal(
        fmt::format("there is nothing to feel: a pull of {:.3g} nN up to Z = {:.3g} nm", 1e9 * pull_n, 1e9 * reach_m));
  }

  const double limit_n_per_m = std::min(kMaxStiffnessNPerM, device.max_stiffness_n_per_m);
  // a weaker scale bends at another depth, so that one step need not be enough
  for (double steepest = steepest_n_per_m(scaling, tables, device); steepest > limit_n_per_m * (1.0 + 1e-9);
       steepest = steepest_n_per_m(scaling, tables, device)) {
    scaling.hand_n_per_n_ *= std::min(0.95, limit_n_per_m / steepest);
    if (scaling.hand_n_per_n_ * reference_n < kFaintestPullN) {
      return refusal(
          fmt::format("beside the stiffness of its contact, of which a hand can be given {:.0f} N/m, its force of "
                      "{:.3g} nN would be too faint to feel; use a softer lever",
                      limit_n_per_m, 1e9 * reference_n));
    }
  }
  return scaling;
}

double FitScaling::hand_force_n(double tip_force_n) const noexcept {
  const double linear_n = hand_n_per_n_ * tip_force_n;
  const double knee_n = kKneeShare * cap_n_;
  if (linear_n <= knee_n) return linear_n;
  const double rest_n = cap_n_ - knee_n;
  return knee_n + rest_n * std::tanh((linear_n - knee_n) / rest_n);
}

}  // namespace afm::haptics
