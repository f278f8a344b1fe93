// SPDX-License-Identifier: Apache-2.0
#include "curves/fitting/curve_fit.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "curves/angle_units.h"
#include "curves/uncertainty_text.h"
#include "fitting/fit_points.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

QuantityDomain domain(const physics::Units& units, double least, double most) {
  return {units.sort, units.units, QuantityRange<double>{least, most}};
}

constexpr double kLeastAngle = std::numbers::pi / 180.0, kMostAngle = std::numbers::pi * 0.49;

// Size that a shape needs, or cannot use.
struct Size {
  const char* name;
  bool needed, given;
};

core::Result<void> check_size(const fits::ShapeRow& shape, const Size& size) {
  if (size.needed && !size.given) {
    return core::wrong_usage(fmt::format("--fit {} needs {}", shape.name, size.name));
  }
  if (!size.needed && size.given) {
    return core::wrong_usage(fmt::format("--fit {} has no use for {}; leave it out", shape.name, size.name));
  }
  return {};
}

core::Result<void> read_uncertainties(const fits::ShapeRow& shape, FitOptions& options) {
  options.uncertainties.clear();
  std::vector<UncertainKey> keys;
  keys.reserve(fits::kGiven.size());
  for (const fits::GivenName& row : fits::kGiven) keys.push_back({row.name, {}});
  const auto parsed = parse_uncertainties(options.uncertainty_texts, keys);
  if (!parsed) return tl::unexpected(parsed.error());
  for (const KeyUncertainty& each : *parsed) {
    const auto& [of, name] = fits::kGiven.at(each.key);
    if ((of == fits::Given::Radius && !shape.has_radius) || (of == fits::Given::HalfAngle && shape.has_radius) ||
        (of == fits::Given::Layer && !shape.has_layer)) {
      return core::wrong_usage(
          fmt::format("--uncertainty {}: --fit {} has no such size; leave it out", name, shape.name));
    }
    const bool is_fixed = (shape.has_layer && !shape.is_exact) || options.poisson == 0.0;
    if (of == fits::Given::Poisson && is_fixed) {
      return core::wrong_usage(
          fmt::format("--uncertainty {}: Poisson's ratio is 0, or fixed by --fit {}; leave it out", name, shape.name));
    }
    options.uncertainties.push_back({of, each.value});
  }
  return {};
}

fits::Indenter indenter_of(const FitOptions& options) {
  fits::Indenter indenter{.shape = *options.shape,
                          .radius_m = options.radius_m,
                          .half_angle_rad = options.half_angle_rad,
                          .layer_m = options.layer_m,
                          .table = options.table,
                          .base = options.base};
  indenter.atomic_distance_m = options.atomic_distance_m.value_or(indenter.atomic_distance_m);
  return indenter;
}

}  // namespace

std::span<const FitNumber> fit_numbers() {
  static const std::array kNumbers{
      FitNumber{"radius", domain(physics::kLengthUnits, 1e-10, 1e-3), "with --fit: radius of the tip",
                [](FitOptions& options, double si) { options.radius_m = si; }},
      FitNumber{"half-angle", domain(kAngleUnits, kLeastAngle, kMostAngle),
                "with --fit: angle between the axis of the tip and its edge (cone) or face (pyramid)",
                [](FitOptions& options, double si) { options.half_angle_rad = si; }},
      FitNumber{"layer", domain(physics::kLengthUnits, 1e-10, 1e-1),
                "with --fit: thickness of the sample on a rigid base",
                [](FitOptions& options, double si) { options.layer_m = si; }},
      FitNumber{"poisson", domain(physics::kPlainNumber, 0.0, 0.5),
                "with --fit: Poisson's ratio of the sample; default: 0.5",
                [](FitOptions& options, double si) { options.poisson = si; }},
      FitNumber{"atomic-distance", domain(physics::kLengthUnits, 0.05e-9, 5e-9),
                "with --fit dmt, jkr, maugis or auto: equilibrium distance z0 of the surfaces, for Maugis' stress and "
                "Tabor's parameter; default: 0.3nm",
                [](FitOptions& options, double si) { options.atomic_distance_m = si; }},
      FitNumber{"most-force", domain(physics::kForceUnits, 1e-13, 1e-1),
                "with --fit: leave out everything after the first greater force above the baseline",
                [](FitOptions& options, double si) { options.most_force_n = si; }},
      FitNumber{
          "most-depth", domain(physics::kLengthUnits, 1e-10, 1e-3),
          "with --fit: leave out everything after the first greater depth below the contact point of the analysis "
          "(--contact-point)",
          [](FitOptions& options, double si) { options.most_depth_m = si; }}};
  return kNumbers;
}

core::Result<void> prepare(FitOptions& options) {
  const bool radius = options.radius_m > 0.0, angle = options.half_angle_rad > 0.0, layer = options.layer_m > 0.0;
  if (!options.shape) {
    if (radius || angle || layer || options.poisson != FitOptions{}.poisson || options.tilt || options.white ||
        options.bootstrap || std::isfinite(options.most_force_n) || std::isfinite(options.most_depth_m) ||
        options.atomic_distance_m || !options.uncertainty_texts.empty() || options.base != FitOptions{}.base ||
        options.against != FitOptions{}.against) {
      return core::wrong_usage("an option of a fit is given without --fit; add --fit SHAPE, such as --fit sphere");
    }
    return {};
  }
  const fits::ShapeRow& shape = fits::row_of(*options.shape);
  for (const Size& size : {Size{"--radius", shape.has_radius, radius}, Size{"--half-angle", !shape.has_radius, angle},
                           Size{"--layer", shape.has_layer, layer}}) {
    if (const auto checked = check_size(shape, size); !checked) return checked;
  }
  if (shape.has_layer && !shape.is_exact && options.poisson != 0.5) {
    return core::wrong_usage(
        fmt::format("--fit {} needs a Poisson's ratio of 0.5; leave --poisson out, or choose layer-exact-sphere or "
                    "layer-exact-cone",
                    shape.name));
  }
  if (!shape.is_exact && options.base != fits::Base::Bonded) {
    return core::wrong_usage(fmt::format("--fit {} has no use for --base; leave it out", shape.name));
  }
  if (shape.is_adhesive && options.against != fits::Against::Z) {
    return core::wrong_usage(fmt::format("--fit {} is against z; leave --against out", shape.name));
  }
  if (options.bootstrap && options.against != fits::Against::Z) {
    return core::wrong_usage("--bootstrap draws forces at known heights, and is against z; leave --against out");
  }
  if (!shape.is_adhesive && options.atomic_distance_m) {
    return core::wrong_usage(fmt::format("--fit {} has no use for --atomic-distance; leave it out", shape.name));
  }
  if (const auto checked = read_uncertainties(shape, options); !checked) return checked;
  if (shape.is_exact) options.table = fits::exact_table(*options.shape, options.base, options.poisson);
  return {};
}

core::Result<fits::ElasticFit> fit_of(const AnalysedCurve& curve, const FitOptions& options) {
  const auto refused = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("cannot fit {}: {}", curve.name, why));
  };
  const auto spring = curve.curve.metadata.spring_constant;
  if (!spring) return refused("it has no spring constant; give --spring-constant");
  if (std::isfinite(options.most_depth_m) && !curve.features.contact_point) {
    return refused("--most-depth counts from the contact point, and it has none; leave it out");
  }
  fits::FitSetup setup{
      .indenter = indenter_of(options),
      .poisson = options.poisson,
      .spring_n_per_m = spring->si,
      .pull_off_n = curve.features.adhesion ? std::fmax(-curve.features.adhesion->force.si, 0.0) : 0.0,
      .pull_off_z_m = curve.features.pull_off ? std::optional(curve.features.pull_off->z.si) : std::nullopt,
      .zero_n = curve.features.baseline.level.si,
      .against = options.against,
      .tilt = options.tilt,
      .white = options.white,
      .starts = {},
      .uncertainties = options.uncertainties,
      .bootstraps = options.bootstrap ? kBootstraps : 0};
  for (const auto& estimate : curve.features.contact_estimates) {
    if (estimate) setup.starts.push_back(estimate->si);
  }
  std::string why;
  auto fit = fits::fit(fit_points(curve, options).samples, setup, why);
  if (!fit) return refused(why);
  return std::move(*fit);
}

}  // namespace afm::curves
