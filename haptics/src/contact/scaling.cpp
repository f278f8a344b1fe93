// SPDX-License-Identifier: Apache-2.0
#include "haptics/scaling.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace afm::haptics {

namespace {

constexpr double kKneeShare = 0.75;
constexpr double kPushShareOfRadius = 0.1;
constexpr double kLeastShareOfDepth = 0.25;  // fraction of a recording's depth that the stroke fills
constexpr double kRounding = 1e-9;           // relative rounding error

// Start of compression, as a fraction of the snap-in, or of the strongest pull without one; and the limit above which
// compression is too weak and is omitted.
constexpr double kBendShareOfSnap = 0.5;
constexpr double kBendShareOfPull = 0.1;
constexpr double kLargestBend = 30.0;       // largest F0 as a multiple of the strongest pull
constexpr double kFaintAtReleaseN = 0.045;  // force on the hand at the release; the governor arms below 0.05 N

// Margin of the release above particles and pull.
constexpr double kOverParticlesM = 0.002;

// Motion of a hand at 50 mm/s in a tick: the slope of a curve over shorter distances is not felt.
constexpr double kHandStepM = 50e-6;

auto refusal(std::string message) { return core::failure(core::ErrorCategory::Failed, std::move(message)); }

using Branch = physics::BranchTable;
using Laws = Scaling::Laws;

// A view of one law as laws.
std::shared_ptr<const physics::LawTables> unowned(const physics::LawTables& tables) {
  return {std::shared_ptr<const physics::LawTables>(), &tables};
}

double force_n(const Branch& branch, double z_m) { return branch.force(physics::Length(z_m)).si; }

// Position above which the force before contact is below this magnitude, from Z_jtc upwards. A recorded curve may push
// there: by a double layer, a brush, or a wave of its baseline.
double faint_above_m(const physics::LawTables& tables, double faint_n) {
  const auto faint = [&](double z_m) { return !(std::abs(force_n(tables.free, z_m)) > faint_n); };
  double near_m = tables.figures.z_jtc.si;
  if (faint(near_m)) return near_m;
  double far_m = std::max(near_m, tables.contact.atomic_distance.si);
  while (!faint(far_m) && std::isfinite(far_m)) far_m *= 2.0;  // doubles the distance; an infinite reach is refused
  constexpr int kMostHalvings = 60;                            // bisections of a force that may cross zero
  for (int i = 0; i < kMostHalvings && far_m - near_m > 1e-6 * std::abs(far_m); ++i) {
    const double middle_m = 0.5 * (near_m + far_m);
    (faint(middle_m) ? far_m : near_m) = middle_m;
  }
  return far_m;
}

// Properties of a material that a scale must accommodate.
struct Extent {
  double reach_m = 0;   // range of Z that the stroke fills
  double strong_n = 0;  // force on the tip that becomes the largest force on the device
  double felt_n = 0;    // force on the tip that must stay strong enough to be felt
};

Extent extent_of(const physics::LawTables& tables) {
  if (tables.tapped_from.si > 0.0) {
    // an amplitude of zero stays below the bend of the force map
    const double strong_n = tables.tapped_full.si / kKneeShare;
    return {tables.tapped_from.si, strong_n, strong_n};
  }
  const double pull_n = strongest_pull_n(tables);
  const double push_n = tables.turn.si > 0.0 ? force_n(tables.pressed, tables.pressed_to.si) : 0.0;
  if (pull_n > Scaling::kFaintShare * push_n) {
    // a recorded curve may detach close to its contact point, or below it
    const double least_m = tables.turn.si > 0.0 ? -kLeastShareOfDepth * tables.pressed_to.si : 0.0;
    const double reach_m = std::max(tables.figures.z_joc.si, faint_above_m(tables, Scaling::kFaintShare * pull_n));
    // the push is felt if the material hardly pulls
    return {std::max(reach_m, least_m), pull_n, std::max(pull_n, push_n)};
  }
  if (tables.turn.si > 0.0) {
    const double depth_m = -tables.pressed_to.si;
    const double strong_n = push_n / kKneeShare;
    return {depth_m * Scaling::kStrokeM / Scaling::kPushM, strong_n, strong_n};
  }
  const double push_m = kPushShareOfRadius * tables.contact.tip_radius.si;
  const double strong_n = force_n(tables.attached, -push_m) / kKneeShare;
  return {push_m * Scaling::kStrokeM / Scaling::kPushM, strong_n, strong_n};
}

// Extent of several laws on one scale.
Extent extent_of(Laws laws) {
  Extent all = extent_of(*laws.front());
  for (const auto& law : laws.subspan(1)) {
    const Extent extent = extent_of(*law);
    all = {std::max(all.reach_m, extent.reach_m), std::max(all.strong_n, extent.strong_n),
           std::max(all.felt_n, extent.felt_n)};
  }
  return all;
}

// True if a law of several has no force that is felt: neither a pull nor the push at the end of the hand's way down.
bool has_faint(const Scaling& scaling, Laws laws) {
  return std::any_of(laws.begin(), laws.end(), [&](const auto& law) {
    const double push_n = force_n(law->attached, scaling.z_m(-Scaling::kPushM));
    return scaling.hand_n_per_n() * std::max(strongest_pull_n(*law), push_n) < Scaling::kFaintestPullN;
  });
}

// Steepest rise of the hand's force on its way down a branch, between two heights of the hand.
double steepest_n_per_m(const Scaling& scaling, const Branch& branch, double lowest_m, double highest_m) {
  double steepest = 0.0;
  double above_n = scaling.hand_force_n(force_n(branch, scaling.z_m(highest_m)));
  for (double height_m = highest_m - kHandStepM; height_m >= lowest_m; height_m -= kHandStepM) {
    const double here_n = scaling.hand_force_n(force_n(branch, scaling.z_m(height_m)));
    steepest = std::max(steepest, (here_n - above_n) / kHandStepM);
    above_n = here_n;
  }
  return steepest;
}

// Largest ratio of the slope on either branch to the allowed stiffness, where it can be felt in the device's workspace.
double excess_of_stiffness(const Scaling& scaling, const physics::LawTables& tables, const DeviceSpec& device) {
  const double lowest_m = device.workspace_min_m.y - device.contact_point_m.y;
  const double highest_m = device.workspace_max_m.y - device.contact_point_m.y;
  const double jump_in_m = scaling.hand_height_m(tables.figures.z_jtc.si);
  const double jump_off_m = scaling.hand_height_m(tables.figures.z_joc.si);
  const double free = steepest_n_per_m(scaling, tables.free, std::clamp(jump_in_m, lowest_m, highest_m), highest_m);
  const double attached =
      steepest_n_per_m(scaling, tables.attached, lowest_m, std::clamp(jump_off_m, lowest_m, highest_m));
  // the pressed branch of a recorded contact, plus the turn from there to the attached branch, which adds at most the
  // contact's mean stiffness (measured_law_tables)
  const double pressed = tables.turn.si > 0.0 ? 2.0 * steepest_n_per_m(scaling, tables.pressed, lowest_m,
                                                                       std::clamp(jump_in_m, lowest_m, highest_m))
                                              : 0.0;
  return std::max({free, attached, pressed}) / std::min(Scaling::kMaxStiffnessNPerM, device.max_stiffness_n_per_m);
}

// Excess of stiffness of several laws on one scale.
double excess_of_stiffness(const Scaling& scaling, Laws laws, const DeviceSpec& device) {
  double most = 0.0;
  for (const auto& law : laws) most = std::max(most, excess_of_stiffness(scaling, *law, device));
  return most;
}

core::Result<void> check_force(const DeviceSpec& device) {
  if (force_cap_n(device) >= Scaling::kFaintestPullN) return {};
  return core::failure(core::ErrorCategory::DeviceMissing,
                       fmt::format("the {} renders at most {:.2g} N, too little to feel; use a stronger device",
                                   device.name, force_cap_n(device)));
}

core::Result<void> check_workspace(const DeviceSpec& device) {
  const double above_m = device.workspace_max_m.y - device.contact_point_m.y;
  if (above_m > Scaling::kStrokeM) return {};
  return core::failure(
      core::ErrorCategory::DeviceMissing,
      fmt::format("cannot fit the stroke of {:.0f} mm to the {}: its reach is {:.0f} mm above the contact point",
                  1e3 * Scaling::kStrokeM, device.name, 1e3 * above_m));
}

core::Result<void> check_extent(const Extent& extent) {
  if (std::isnormal(extent.reach_m) && extent.reach_m > 0.0 && std::isnormal(extent.strong_n) && extent.strong_n > 0.0)
    return {};
  return refusal(fmt::format("too weak to feel: a pull of {:.3g} nN up to Z = {:.3g} nm", 1e9 * extent.strong_n,
                             1e9 * extent.reach_m));
}

core::Result<void> check_release(double release_m, const DeviceSpec& device) {
  const double highest_m = device.workspace_max_m.y - device.contact_point_m.y - Scaling::kRecoilM;
  if (release_m <= highest_m) return {};
  return refusal(
      fmt::format("on the scale of the particles the tip is free {:.0f} mm above the sample, and the {} reaches {:.0f} "
                  "mm; use a stiffer lever, or larger particles",
                  1e3 * release_m, device.name, 1e3 * highest_m));
}

double common_stroke_m(const DeviceSpec& device) {
  return device.workspace_max_m.y - device.contact_point_m.y - Scaling::kRecoilM - Scaling::common_zero_m(device);
}

}  // namespace

double strongest_pull_n(const physics::LawTables& tables) {
  const physics::CycleFigures& figures = tables.figures;
  double strongest_n = std::max({0.0, -figures.force_before_joc.si, -figures.force_before_jtc.si});
  const double nearest_m = 1e-4 * tables.contact.atomic_distance.si;
  const double farthest_m = std::max(std::abs(figures.z_joc.si), tables.contact.tip_radius.si);
  for (double distance_m = nearest_m; distance_m < farthest_m; distance_m *= 1.02) {
    strongest_n = std::max({strongest_n, -force_n(tables.attached, figures.z_joc.si - distance_m),
                            -force_n(tables.free, figures.z_jtc.si + distance_m)});
  }
  return strongest_n;
}

double strongest_force_n(const physics::LawTables& tables) { return extent_of(tables).strong_n; }

double compression_bend_n(const physics::LawTables& tables) {
  const double strong_n = strongest_force_n(tables);
  const double snap_n = std::abs(tables.figures.force_after_jtc.si);
  if (!tables.figures.hysteretic || !(snap_n > 0.0)) return kBendShareOfPull * strong_n;
  return std::min(kBendShareOfSnap * snap_n, strong_n);
}

core::Result<Scaling> Scaling::fit(const physics::LawTables& tables, const DeviceSpec& device) {
  return fit(std::array{unowned(tables)}, device);
}

core::Result<Scaling> Scaling::common(const physics::LawTables& tables, const DeviceSpec& device,
                                      const CommonScale& scale) {
  return common(std::array{unowned(tables)}, device, scale);
}

core::Result<Scaling> Scaling::fit(Laws laws, const DeviceSpec& device) {
  if (auto enough = check_force(device); !enough) return tl::unexpected(enough.error());
  if (auto enough = check_workspace(device); !enough) return tl::unexpected(enough.error());
  const Extent extent = extent_of(laws);
  if (auto some = check_extent(extent); !some) return tl::unexpected(some.error());
  Scaling scaling;
  scaling.cap_n_ = force_cap_n(device);
  scaling.hand_m_per_m_ = scaling.lateral_m_per_m_ = kStrokeM / extent.reach_m;
  scaling.hand_n_per_n_ = scaling.cap_n_ / extent.strong_n;

  // a weaker scale bends at another depth, so one step may not be enough
  for (double excess = excess_of_stiffness(scaling, laws, device); excess > 1.0 + kRounding;
       excess = excess_of_stiffness(scaling, laws, device)) {
    scaling.hand_n_per_n_ *= std::min(0.95, 1.0 / excess);
    if (scaling.hand_n_per_n_ * extent.felt_n < kFaintestPullN) {
      return refusal(
          fmt::format("a hand can be given a contact stiffness of {:.0f} N/m; at that scale its force of {:.3g} nN is "
                      "too weak to feel; use a softer lever",
                      std::min(kMaxStiffnessNPerM, device.max_stiffness_n_per_m), 1e9 * extent.strong_n));
    }
  }
  if (laws.size() > 1 && has_faint(scaling, laws)) {
    return refusal(
        fmt::format("its forces differ too much from place to place: on the scale of the strongest, {:.3g} nN, the "
                    "weakest are too weak to feel",
                    1e9 * extent.strong_n));
  }
  return scaling;
}

core::Result<Scaling> Scaling::compressed(Laws laws, const DeviceSpec& device) {
  auto scaling = fit(laws, device);
  if (!scaling) return scaling;
  scaling->mode_ = scene::ScaleMode::Compressed;
  const double strong_n = extent_of(laws).strong_n;
  double bend_n = strong_n;
  for (const auto& law : laws) bend_n = std::min(bend_n, compression_bend_n(*law));
  while (bend_n < kLargestBend * strong_n) {
    scaling->bend_n_ = bend_n;
    scaling->bend_gain_n_ = scaling->hand_n_per_n_ * strong_n / std::asinh(strong_n / bend_n);
    // long-range attraction must be too weak to be felt where the force is turned on
    double afar_n = 0.0;
    for (const auto& law : laws) {
      afar_n = std::max(afar_n, -scaling->hand_force_n(force_n(law->free, scaling->release_z_m())));
    }
    const double excess = std::max(excess_of_stiffness(*scaling, laws, device), afar_n / kFaintAtReleaseN);
    if (excess <= 1.0 + kRounding) return scaling;
    bend_n *= std::clamp(excess, 1.002, 1.2);
  }
  // without compression, the contact is already at the stiffness limit
  scaling->bend_n_ = 0.0;
  return scaling;
}

core::Result<Scaling> Scaling::atoms(Laws laws, const DeviceSpec& device, double period_m) {
  auto scaling = fit(laws, device);
  if (!scaling) return scaling;
  scaling->mode_ = scene::ScaleMode::Atoms;
  scaling->lateral_m_per_m_ = lateral_m_per_m(scene::ScaleMode::Atoms, scaling->hand_m_per_m_, period_m);
  return scaling;
}

double Scaling::lateral_m_per_m(scene::ScaleMode mode, double hand_m_per_m, double period_m) noexcept {
  if (mode != scene::ScaleMode::Atoms) return hand_m_per_m;
  return std::max(hand_m_per_m, kAtomM / (period_m > 0.0 ? period_m : kUsualPeriodM));
}

double Scaling::common_zero_m(const DeviceSpec& device) noexcept {
  return device.workspace_min_m.y - device.contact_point_m.y + kPushM;
}

core::Result<Scaling> Scaling::common(Laws laws, const DeviceSpec& device, const CommonScale& scale) {
  if (auto enough = check_force(device); !enough) return tl::unexpected(enough.error());
  if (auto enough = check_workspace(device); !enough) return tl::unexpected(enough.error());
  const Extent extent = extent_of(laws);
  if (auto some = check_extent(extent); !some) return tl::unexpected(some.error());
  Scaling scaling;
  scaling.mode_ = scene::ScaleMode::Common;
  scaling.cap_n_ = force_cap_n(device);
  scaling.zero_m_ = common_zero_m(device);
  scaling.hand_m_per_m_ = std::min(scale.hand_m_per_m, common_stroke_m(device) / extent.reach_m);
  scaling.lateral_m_per_m_ = scaling.hand_m_per_m_;
  scaling.hand_n_per_n_ = std::min(scale.hand_n_per_n, scaling.cap_n_ / extent.strong_n);
  scaling.release_m_ = scaling.hand_height_m(extent.reach_m);
  for (double excess = excess_of_stiffness(scaling, laws, device); excess > 1.0 + kRounding;
       excess = excess_of_stiffness(scaling, laws, device)) {
    scaling.hand_n_per_n_ *= std::min(0.95, 1.0 / excess);
  }
  return scaling;
}

core::Result<Scaling> Scaling::particles(const physics::LawTables& tables, const DeviceSpec& device,
                                         const ParticleScale& scale) {
  if (auto enough = check_force(device); !enough) return tl::unexpected(enough.error());
  const Extent extent = extent_of(tables);
  if (auto some = check_extent(extent); !some) return tl::unexpected(some.error());
  Scaling scaling;
  scaling.mode_ = scene::ScaleMode::Particles;
  scaling.cap_n_ = force_cap_n(device);
  scaling.hand_m_per_m_ = scaling.lateral_m_per_m_ = scale.hand_m_per_m;
  scaling.hand_n_per_n_ = scaling.cap_n_ / extent.strong_n;
  scaling.reach_m_ = extent.reach_m;
  scaling.clear_particles(scale.clear_z_m);
  if (auto free = check_release(scaling.release_m_, device); !free) return tl::unexpected(free.error());
  const double most_n_per_m = std::min(kMaxStiffnessNPerM, device.max_stiffness_n_per_m);
  const double law_share = 1.0 - particle_stiffness_n_per_m(device) / most_n_per_m;
  for (double excess = excess_of_stiffness(scaling, tables, device) / law_share; excess > 1.0 + kRounding;
       excess = excess_of_stiffness(scaling, tables, device) / law_share) {
    scaling.hand_n_per_n_ *= std::min(0.95, 1.0 / excess);
  }
  return scaling;
}

void Scaling::clear_particles(double clear_z_m) noexcept {
  release_m_ = hand_height_m(std::max(reach_m_, clear_z_m)) + kOverParticlesM;
}

core::Result<void> Scaling::check_clear(const ParticleScale& scale, const DeviceSpec& device) {
  return check_release(scale.clear_z_m * scale.hand_m_per_m + kOverParticlesM, device);
}

core::Result<CommonScale> Scaling::common_scale(std::span<const std::shared_ptr<const physics::LawTables>> materials,
                                                const DeviceSpec& device) {
  CommonScale scale{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const auto& tables : materials) {
    scale.hand_m_per_m = std::min(scale.hand_m_per_m, common_stroke_m(device) / extent_of(*tables).reach_m);
  }
  // the stiffness depends on both, so the lengths come first
  for (const auto& tables : materials) {
    const auto alone = common(*tables, device, scale);
    if (!alone) return tl::unexpected(alone.error());
    scale.hand_n_per_n = std::min(scale.hand_n_per_n, alone->hand_n_per_n());
  }
  return scale;
}

double Scaling::hand_force_n(double tip_force_n) const noexcept {
  const double wanted_n =
      bend_n_ > 0.0 ? bend_gain_n_ * std::asinh(tip_force_n / bend_n_) : hand_n_per_n_ * tip_force_n;
  const double knee_n = kKneeShare * cap_n_;
  if (wanted_n <= knee_n) return wanted_n;
  const double rest_n = cap_n_ - knee_n;
  return knee_n + rest_n * std::tanh((wanted_n - knee_n) / rest_n);
}

}  // namespace afm::haptics
