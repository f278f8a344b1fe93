// SPDX-License-Identifier: Apache-2.0
#include "curves/synthetic_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/json_text.h"
#include "core/version.h"
#include "fits/driven_contact.h"
#include "physics/normal_generator.h"
#include "synthetic_truth.h"

namespace afm::curves {

namespace {

using physics::format_si;

fits::Indenter indenter_of(const SyntheticSetup& setup) {
  fits::Indenter indenter{.shape = setup.shape,
                          .radius_m = setup.radius_m,
                          .half_angle_rad = setup.half_angle_rad,
                          .layer_m = setup.layer_m,
                          .base = setup.base,
                          .atomic_distance_m = setup.atomic_distance_m};
  if (fits::row_of(setup.shape).is_exact) {
    indenter.table = fits::exact_table(setup.shape, setup.base, setup.poisson);
  }
  return indenter;
}

core::Result<void> check_depth(const fits::Indenter& indenter, double depth_m) {
  const fits::ShapeRow& law = fits::row_of(indenter.shape);
  const auto refused = [&](const std::string& why) {
    return core::wrong_usage(fmt::format("--law {}: the tip would go {} deep, {}; lower --most-force", law.name,
                                         format_si(depth_m, physics::kLengthUnits.units, 3), why));
  };
  if (fits::layer_strain(indenter, depth_m) > 1.0) return refused("deeper than the layer's formula holds");
  if (law.has_radius && indenter.shape != fits::Shape::Sphere && depth_m > indenter.radius_m) {
    return refused("more than its radius, where its paraboloid is no sphere any more");
  }
  return {};
}

// Heights of the base and of the sample over time. The base goes down in equal steps, stays for one, and goes up.
class Path {
 public:
  Path(const SyntheticSetup& setup, double clearance_m, double deepest_way_m)
      : points_(setup.points), speed_(setup.speed_m_per_s), drift_(setup.drift_m_per_s) {
    first_m_ = setup.contact_m + clearance_m;
    ground_m_ = setup.contact_m - drift_ * clearance_m / speed_;
    // where the sample, at ground + drift (first - z)/speed, is deepest_way above the base
    const double share = drift_ / speed_;
    turn_m_ = (ground_m_ + share * first_m_ - deepest_way_m) / (1.0 + share);
    step_m_ = (first_m_ - turn_m_) / static_cast<double>(points_ - 1);
  }

  double turn_m() const { return turn_m_; }
  double time_s(std::size_t point) const { return static_cast<double>(point) * step_m_ / speed_; }
  double base_m(std::size_t point) const {
    return point < points_ ? first_m_ - static_cast<double>(point) * step_m_
                           : turn_m_ + static_cast<double>(point - points_) * step_m_;
  }
  double way_m(std::size_t point) const { return ground_m_ + drift_ * time_s(point) - base_m(point); }

  // Height of the base where the retract has this way.
  double retract_at(double way_m) const {
    const double share = drift_ / speed_;
    const double turned_m = ground_m_ + drift_ * time_s(points_) - share * turn_m_;
    return (turned_m - way_m) / (1.0 - share);
  }

 private:
  std::size_t points_;
  double speed_, drift_, first_m_ = 0, ground_m_ = 0, turn_m_ = 0, step_m_ = 0;
};

// Random number from -1 to 1 with equal probability.
double uniform(physics::NormalGenerator& random) { return std::erf(random() / std::numbers::sqrt2); }

// Deviations that an instrument adds to the force.
class Instrument {
 public:
  Instrument(const SyntheticSetup& setup, std::uint64_t seed, double first_m)
      : setup_(setup), random_(seed), first_m_(first_m) {
    if (setup.wave_n > 0.0) phase_rad_ = std::numbers::pi * uniform(random_);
    slow_ = random_();
  }

  double recorded_n(double force_n, double base_m) {
    double sum_n = force_n + setup_.level_n + setup_.tilt_n_per_m * (base_m - first_m_);
    if (setup_.wave_n > 0.0) {
      sum_n += setup_.wave_n * std::sin(2.0 * std::numbers::pi * base_m / setup_.wave_period_m + phase_rad_);
    }
    const double memory = setup_.noise_memory;
    slow_ = memory * slow_ + std::sqrt(1.0 - memory * memory) * random_();
    return digitised_n(sum_n + setup_.noise_n * slow_);
  }

  double phase_rad() const { return phase_rad_; }
  std::size_t saturated() const { return saturated_; }

 private:
  double digitised_n(double force_n) {
    if (!(setup_.bits > 0.0)) return force_n;
    const double newton_per_volt = setup_.spring_n_per_m * setup_.sensitivity_m_per_v;
    const double step_v = std::ldexp(2.0 * kDetectorRangeV, -static_cast<int>(setup_.bits));
    const double volts = step_v * std::round(force_n / newton_per_volt / step_v);
    if (std::abs(volts) > kDetectorRangeV) ++saturated_;
    return newton_per_volt * std::clamp(volts, -kDetectorRangeV, kDetectorRangeV);
  }

  const SyntheticSetup& setup_;
  physics::NormalGenerator random_;
  double first_m_, phase_rad_ = 0, slow_ = 0;
  std::size_t saturated_ = 0;
};

struct Made {
  RecordedCurve curve;
  nlohmann::ordered_json truth;
};

void describe(const SyntheticSetup& setup, CurveMetadata& metadata) {
  metadata.spring_constant = physics::Stiffness(setup.spring_n_per_m);
  if (setup.sensitivity_m_per_v > 0.0) metadata.sensitivity_m_per_v = setup.sensitivity_m_per_v;
  metadata.approach_speed = metadata.retract_speed = physics::Velocity(setup.speed_m_per_s);
  metadata.setpoint = physics::Force(setup.most_force_n);
  metadata.instrument = metadata.software = kSyntheticBy;
  metadata.software_version = core::kVersion;
}

constexpr double kFreeShare = 3.0;     // clearance as a multiple of the way of the pull-off
constexpr double kLongestWayM = 1e-3;  // longest way of a base, up or down

core::Result<Made> one_curve(const SyntheticSetup& setup, const fits::Indenter& indenter, std::uint64_t seed) {
  const double reduced_pa = setup.modulus_pa / (1.0 - setup.poisson * setup.poisson);
  fits::DrivenContact contact(indenter, reduced_pa, setup.work_j_per_m2, setup.spring_n_per_m);
  const double deepest_way_m = contact.way_of(setup.most_force_n);
  const double off_m = std::abs(contact.way_off_m());
  if (!(std::max(deepest_way_m, kFreeShare * off_m) <= kLongestWayM)) {
    return core::wrong_usage(fmt::format(
        "the base would go {} below the contact, and the tip come off {} above it; lower --most-force, or raise "
        "--spring-constant",
        format_si(deepest_way_m, physics::kLengthUnits.units, 3), format_si(off_m, physics::kLengthUnits.units, 3)));
  }
  const double depth_m = contact.approaching(deepest_way_m).depth_m;
  if (const auto checked = check_depth(indenter, depth_m); !checked) return tl::unexpected(checked.error());
  const double clearance_m = setup.clearance_m > 0.0 ? setup.clearance_m : std::max(deepest_way_m, kFreeShare * off_m);
  if (clearance_m <= off_m) {
    return core::wrong_usage(fmt::format("--clearance {}: the tip comes off {} above the contact; begin higher",
                                         format_si(clearance_m, physics::kLengthUnits.units),
                                         format_si(off_m, physics::kLengthUnits.units)));
  }

  const Path path(setup, clearance_m, deepest_way_m);
  Instrument instrument(setup, seed, path.base_m(0));
  Made made;
  describe(setup, made.curve.metadata);
  for (std::size_t i = 0; i < 2 * setup.points; ++i) {
    const bool approaches = i < setup.points;
    const double base_m = path.base_m(i), way_m = path.way_m(i);
    const double force_n = (approaches ? contact.approaching(way_m) : contact.retracting(way_m)).force_n;
    made.curve.points.push_back({physics::Length(base_m), physics::Force(instrument.recorded_n(force_n, base_m)),
                                 approaches ? physics::Branch::Approach : physics::Branch::Retract});
    made.curve.time_s.push_back(path.time_s(i));
  }

  made.truth = {{"modulus_Pa", setup.modulus_pa}, {"reduced_modulus_Pa", reduced_pa},
                {"contact_z_m", setup.contact_m}, {"contact_retract_z_m", path.retract_at(0.0)},
                {"first_z_m", path.base_m(0)},    {"turn_z_m", path.turn_m()},
                {"greatest_depth_m", depth_m}};
  if (off_m > 0.0) {
    made.truth["work_of_adhesion_J_per_m2"] = setup.work_j_per_m2;
    made.truth["pull_off_z_m"] = path.retract_at(contact.way_off_m());
    made.truth["pull_off_N"] = contact.pull_off_n();
    made.truth["tabor_parameter"] = contact.tabor();
  }
  if (setup.wave_n > 0.0) made.truth["wave_phase_rad"] = instrument.phase_rad();
  if (setup.bits > 0.0) made.truth["saturated_points"] = instrument.saturated();
  return made;
}

core::Result<void> check_points(const SyntheticSetup& setup, std::size_t count) {
  if (2 * setup.points <= kMostSyntheticPoints / count) return {};
  return core::wrong_usage(fmt::format("{} curves of {} points are more than {} in all; lower their number or --points",
                                       count, 2 * setup.points, kMostSyntheticPoints));
}

// Seed of a curve: the curves of two files have none in common.
std::uint64_t seed_of(const SyntheticSetup& setup, std::size_t index) {
  return (static_cast<std::uint64_t>(setup.seed) << 32U) + index;
}

// Share of the second values at a place, from 0 to 1; x and y go from 0 to 1 across the map.
class Shares {
 public:
  Shares(FieldShape shape, const SyntheticSetup& setup, const MapGrid& grid) : shape_(shape), grid_(grid) {
    physics::NormalGenerator random(~seed_of(setup, 0));
    for (Disc& disc : discs_) {
      constexpr double kLeast = 0.06, kMore = 0.03;
      disc = {0.5 + 0.45 * uniform(random), 0.5 + 0.45 * uniform(random), kLeast + kMore * (1.0 + uniform(random))};
    }
  }

  double at(std::size_t column, std::size_t row) const {
    const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(grid_.columns);
    const double y = (static_cast<double>(row) + 0.5) / static_cast<double>(grid_.rows);
    switch (shape_) {
      case FieldShape::Uniform:
        return 0.0;
      case FieldShape::Step:
        return x > 0.5 ? 1.0 : 0.0;
      case FieldShape::Gradient:
        return grid_.columns > 1 ? static_cast<double>(column) / static_cast<double>(grid_.columns - 1) : 0.0;
      case FieldShape::Islands:
        break;
    }
    return std::any_of(discs_.begin(), discs_.end(),
                       [&](const Disc& disc) { return std::hypot(x - disc.x, y - disc.y) < disc.radius; })
               ? 1.0
               : 0.0;
  }

 private:
  struct Disc {
    double x = 0, y = 0, radius = 0;
  };
  FieldShape shape_;
  const MapGrid& grid_;
  std::array<Disc, 5> discs_{};
};

core::Result<void> check_seconds(const SyntheticSetup& setup, const SyntheticMap& map) {
  const bool modulus = map.second_modulus_pa > 0.0, work = map.second_work_j_per_m2 > 0.0;
  const std::string_view law = fits::row_of(setup.shape).name;
  if (map.shape == FieldShape::Uniform && (modulus || work)) {
    return core::wrong_usage(
        "--field uniform has no second value; choose step, gradient or islands, or leave --second-... out");
  }
  if (map.shape != FieldShape::Uniform && !modulus && !work) {
    return core::wrong_usage("this --field needs --second-modulus, or with adhesion --second-work-of-adhesion");
  }
  if (work && !fits::row_of(setup.shape).is_adhesive) {
    return core::wrong_usage(fmt::format("--second-work-of-adhesion: --law {} has no use for it; leave it out", law));
  }
  return {};
}

}  // namespace

core::Result<SyntheticFile> synthetic_curves(const SyntheticSetup& setup, std::size_t count) {
  if (const auto checked = check_points(setup, count); !checked) return tl::unexpected(checked.error());
  const fits::Indenter indenter = indenter_of(setup);
  SyntheticFile file;
  nlohmann::ordered_json truth = truth_of(setup, "curve");
  for (std::size_t index = 0; index < count; ++index) {
    auto made = one_curve(setup, indenter, seed_of(setup, index));
    if (!made) return tl::unexpected(made.error());
    file.curves.push_back(std::move(made->curve));
    truth["curves"].push_back(std::move(made->truth));
  }
  file.truth = core::json_text(truth, 2) + "\n";
  return file;
}

core::Result<SyntheticFile> synthetic_map(const SyntheticSetup& setup, const SyntheticMap& map) {
  const MapGrid& grid = map.grid;
  if (const auto checked = check_seconds(setup, map); !checked) return tl::unexpected(checked.error());
  if (const auto checked = check_points(setup, grid.columns * grid.rows); !checked) {
    return tl::unexpected(checked.error());
  }
  const fits::Indenter indenter = indenter_of(setup);
  const Shares shares(map.shape, setup, grid);
  SyntheticFile file;
  nlohmann::ordered_json truth = truth_of(setup, "map");
  for (std::size_t index = 0; index < grid.columns * grid.rows; ++index) {
    const std::size_t column = index % grid.columns, row = index / grid.columns;
    SyntheticSetup here(setup);
    const auto mixed = [share = shares.at(column, row)](double first, double second) {
      return second > 0.0 ? std::lerp(first, second, share) : first;
    };
    here.modulus_pa = mixed(setup.modulus_pa, map.second_modulus_pa);
    here.work_j_per_m2 = mixed(setup.work_j_per_m2, map.second_work_j_per_m2);
    auto made = one_curve(here, indenter, seed_of(setup, index));
    if (!made) return tl::unexpected(made.error());
    CurveMetadata& metadata = made->curve.metadata;
    metadata.pixel = {grid, column, row};
    metadata.position = centre_of(*metadata.pixel);
    file.curves.push_back(std::move(made->curve));
    truth["curves"].push_back(std::move(made->truth));
  }
  add_map(map, file.curves, truth);
  file.truth = core::json_text(truth, 2) + "\n";
  return file;
}

}  // namespace afm::curves
