// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/analyse_fit.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/options/angle_units.h"
#include "app/options/enum_option.h"
#include "app/options/quantity_option.h"
#include "curves/plot_units.h"
#include "physics/quantity_text.h"

namespace afm::app {

namespace {

using physics::format_quantity;
using FitJson = nlohmann::ordered_json;

constexpr QuantityRange<physics::Length> kRadii{physics::Length(1e-10), physics::Length(1e-3)};
constexpr QuantityRange<physics::Force> kMostForces{physics::Force(1e-13), physics::Force(1e-1)};
constexpr QuantityRange<physics::Length> kLayers{physics::Length(1e-10), physics::Length(1e-1)};
constexpr QuantityRange<double> kHalfAngles{std::numbers::pi / 180.0, std::numbers::pi * 0.49};
constexpr double kLeastPoisson = 0.0, kMostPoisson = 0.5;
constexpr int kDigits = 4;

// An option that a shape needs, or cannot use.
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

// The approach up to the first point that exceeds a limit. The depth counts from the contact point of the analysis, not
// of the fit: that one moves with what is left out, on a sample that stiffens further and further.
std::vector<fits::Sample> approach_of(const curves::AnalysedCurve& curve, double spring_n_per_m,
                                      const FitOptions& options) {
  const physics::CurveFeatures& features = curve.features;
  std::vector<fits::Sample> approach;
  for (const physics::CurvePoint& point : curve.curve.points) {
    if (point.branch != physics::Branch::Approach) continue;
    const double force_n = (point.force - features.baseline.at(point.z)).si;
    const double bent_m = force_n / spring_n_per_m;
    const double depth_m = features.contact_point ? features.contact_point->si - (point.z.si + bent_m) : 0.0;
    if (force_n > options.most_force_n || depth_m > options.most_depth_m) break;
    approach.push_back({point.z.si, point.force.si});
  }
  return approach;
}

std::string pressure_text(double pa) {
  return format_quantity(physics::Pressure(pa), physics::kPressureUnits, kDigits);
}
std::string length_text(double m) { return format_quantity(physics::Length(m), physics::kLengthUnits, kDigits); }
std::string force_text(double n) { return format_quantity(physics::Force(n), physics::kForceUnits, kDigits); }

std::string_view name_of(fits::Against against) { return fits::kAgainst.at(static_cast<std::size_t>(against)).name; }
std::string_view name_of(fits::Base base) { return fits::kBases.at(static_cast<std::size_t>(base)).name; }

std::string size_text(const FitOptions& options) {
  const fits::ShapeRow& shape = fits::row_of(*options.shape);
  std::string text = shape.has_radius
                         ? "R = " + length_text(options.radius_m)
                         : "half angle " + physics::format_si(options.half_angle_rad, kAngleUnits.units, kDigits);
  if (shape.has_layer) text += ", layer of " + length_text(options.layer_m);
  if (shape.is_exact) text += fmt::format(", {}", name_of(options.base));
  return text + fmt::format(", nu = {:g}", options.poisson);
}

}  // namespace

std::vector<NamedOption> add_fit_options(OptionList& command, FitOptions& options) {
  std::string shapes;
  for (const fits::ShapeRow& row : fits::kShapes) shapes += fmt::format("\n  {}: {}", row.name, row.meaning);
  std::vector<NamedOption> added;
  const auto add = [&added](const char* name, const Option& option) { added.push_back({option, name}); };
  add("--fit", enum_option(command, "--fit", options.shape, "a shape of the tip", fits::kShapes, &fits::ShapeRow::name,
                           &fits::ShapeRow::shape, "fit the elastic modulus to the approach:" + shapes));
  add("--radius", quantity_option(
                      command, "--radius", [&options](physics::Length radius) { options.radius_m = radius.si; },
                      physics::kLengthUnits, "of --fit: radius of the tip", std::optional(kRadii)));
  add("--half-angle", si_option(
                          command, "--half-angle", [&options](double rad) { options.half_angle_rad = rad; },
                          {kAngleUnits.sort, kAngleUnits.units, kHalfAngles},
                          "of --fit: angle between the axis of the tip and its edge (cone) or face (pyramid)"));
  add("--layer",
      quantity_option(
          command, "--layer", [&options](physics::Length layer) { options.layer_m = layer.si; }, physics::kLengthUnits,
          "of --fit: thickness of the sample on a rigid base", std::optional(kLayers)));
  add("--base",
      enum_option(command, "--base", options.base, "a base", fits::kBases, &fits::BaseName::name, &fits::BaseName::base,
                  "of --fit layer-exact-...: how the layer lies on it; default: bonded"));
  add("--poisson",
      si_option(
          command, "--poisson", [&options](double ratio) { options.poisson = ratio; },
          {physics::kPlainNumber.sort, physics::kPlainNumber.units, QuantityRange<double>{kLeastPoisson, kMostPoisson}},
          "of --fit: Poisson's ratio of the sample; default: 0.5"));
  add("--against",
      enum_option(command, "--against", options.against, "a variable", fits::kAgainst, &fits::AgainstName::name,
                  &fits::AgainstName::against,
                  "of --fit: z, the height of the lever's base, or tip, the tip position of nanite and AtomicJ; "
                  "default: z"));
  add("--most-force",
      quantity_option(
          command, "--most-force", [&options](physics::Force force) { options.most_force_n = force.si; },
          physics::kForceUnits, "of --fit: leave out what comes after a greater force above the baseline",
          std::optional(kMostForces)));
  add("--most-depth", quantity_option(
                          command, "--most-depth",
                          [&options](physics::Length depth) { options.most_depth_m = depth.si; }, physics::kLengthUnits,
                          "of --fit: leave out what comes after a greater depth below the contact point of the "
                          "analysis (--contact-point)",
                          std::optional(kRadii)));
  add("--tilt", command.add_flag("--tilt", options.tilt, "of --fit: also fit a tilt of the baseline"));
  add("--white-noise", command.add_flag("--white-noise", options.white,
                                        "of --fit: assume white noise, as nanite and AtomicJ do; its interval is "
                                        "too narrow where it is not"));
  return added;
}

core::Result<void> prepare(FitOptions& options) {
  const bool radius = options.radius_m > 0.0, angle = options.half_angle_rad > 0.0, layer = options.layer_m > 0.0;
  if (!options.shape) {
    if (radius || angle || layer || options.poisson != FitOptions{}.poisson || options.tilt || options.white ||
        std::isfinite(options.most_force_n) || std::isfinite(options.most_depth_m) ||
        options.base != FitOptions{}.base || options.against != FitOptions{}.against) {
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
    return core::wrong_usage(fmt::format(
        "--fit {} knows Poisson's ratio 0.5 alone; leave --poisson out, or take layer-exact-sphere or layer-exact-cone",
        shape.name));
  }
  if (!shape.is_exact && options.base != fits::Base::Bonded) {
    return core::wrong_usage(fmt::format("--fit {} has no use for --base; leave it out", shape.name));
  }
  if (shape.is_exact) options.table = fits::exact_table(*options.shape, options.base, options.poisson);
  return {};
}

core::Result<fits::ElasticFit> fit_of(const curves::AnalysedCurve& curve, const FitOptions& options) {
  const auto refused = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("cannot fit {}: {}", curve.name, why));
  };
  const auto spring = curve.curve.metadata.spring_constant;
  if (!spring) return refused("it has no spring constant; give --spring-constant");
  if (std::isfinite(options.most_depth_m) && !curve.features.contact_point) {
    return refused("--most-depth counts from the contact point, and it has none; leave it out");
  }
  fits::FitSetup setup{.indenter = {.shape = *options.shape,
                                    .radius_m = options.radius_m,
                                    .half_angle_rad = options.half_angle_rad,
                                    .layer_m = options.layer_m,
                                    .table = options.table},
                       .poisson = options.poisson,
                       .spring_n_per_m = spring->si,
                       .pull_off_n = curve.features.adhesion ? std::abs(curve.features.adhesion->force.si) : 0.0,
                       .zero_n = curve.features.baseline.level.si,
                       .against = options.against,
                       .tilt = options.tilt,
                       .white = options.white,
                       .starts = {}};
  for (const auto& estimate : curve.features.contact_estimates) {
    if (estimate) setup.starts.push_back(estimate->si);
  }
  std::string why;
  auto fit = fits::fit(approach_of(curve, spring->si, options), setup, why);
  if (!fit) return refused(why);
  return std::move(*fit);
}

std::string fit_text(const fits::ElasticFit& fit, const FitOptions& options) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  const auto line = [&](const char* title, const std::string& value) {
    fmt::format_to(out, "{:<16}{:>16}\n", title, value);
  };
  const fits::ShapeRow& shape = fits::row_of(*options.shape);
  fmt::format_to(out, "\nfit of {} ({}; {}), force against {}\n", shape.name, shape.meaning, size_text(options),
                 options.against == fits::Against::Z ? "Z" : "the tip position");
  line("modulus E", pressure_text(fit.modulus_pa));
  line("  95 % from", fit.modulus_interval_pa.low > 0.0 ? pressure_text(fit.modulus_interval_pa.low) : "not found");
  line("  to", std::isfinite(fit.modulus_interval_pa.high) ? pressure_text(fit.modulus_interval_pa.high) : "not found");
  line("reduced modulus", pressure_text(fit.reduced_modulus_pa));
  line("contact at", length_text(fit.contact_z_m));
  line("level", force_text(fit.level_n));
  if (options.tilt) {
    line("tilt", format_quantity(physics::Stiffness(fit.tilt_n_per_m), physics::kStiffnessUnits, kDigits));
  }
  line("depth", length_text(fit.depth_m));
  line("rms of residuals", force_text(fit.rms_n));
  line("points", fmt::format("{}", fit.points));
  line("  in contact", fmt::format("{}", fit.in_contact));
  line("noise", force_text(fit.noise_n));
  line("  its order", options.white     ? "assumed white"
                      : fit.noise_order ? fmt::format("{}", *fit.noise_order)
                                        : "no noise");
  line("trust", std::string(fits::name_of(fit.trust)));
  for (const fits::Found& found : fit.doubts) {
    fmt::format_to(out, "  {} {:.3g} (limit {:g})\n", fits::kDoubts.at(static_cast<std::size_t>(found.doubt)).name,
                   found.figure, found.limit);
  }
  fmt::format_to(out,
                 "the interval is that of the noise alone: errors of spring constant, sensitivity and radius come on "
                 "top\n");
  return fmt::to_string(text);
}

FitJson fit_json(const fits::ElasticFit& fit, const FitOptions& options) {
  const fits::ShapeRow& shape = fits::row_of(*options.shape);
  const auto limit = [](double value) { return std::isfinite(value) ? FitJson(value) : FitJson(); };
  FitJson result{{"shape", shape.name},
                 {"source", shape.meaning},
                 {"radius_m", shape.has_radius ? FitJson(options.radius_m) : FitJson()},
                 {"half_angle_rad", shape.has_radius ? FitJson() : FitJson(options.half_angle_rad)},
                 {"layer_m", shape.has_layer ? FitJson(options.layer_m) : FitJson()},
                 {"base", shape.is_exact ? FitJson(name_of(options.base)) : FitJson()},
                 {"poisson_ratio", options.poisson},
                 {"against", name_of(options.against)},
                 {"most_force_N", limit(options.most_force_n)},
                 {"most_depth_m", limit(options.most_depth_m)},
                 {"modulus_Pa", fit.modulus_pa},
                 {"modulus_95_percent_Pa",
                  {fit.modulus_interval_pa.low > 0.0 ? FitJson(fit.modulus_interval_pa.low) : FitJson(),
                   std::isfinite(fit.modulus_interval_pa.high) ? FitJson(fit.modulus_interval_pa.high) : FitJson()}},
                 {"reduced_modulus_Pa", fit.reduced_modulus_pa},
                 {"contact_m", fit.contact_z_m},
                 {"level_N", fit.level_n},
                 {"tilt_N_per_m", options.tilt ? FitJson(fit.tilt_n_per_m) : FitJson()},
                 {"depth_m", fit.depth_m},
                 {"rms_N", fit.rms_n},
                 {"points", fit.points},
                 {"points_in_contact", fit.in_contact},
                 {"noise_N", fit.noise_n},
                 {"noise_order", fit.noise_order ? FitJson(*fit.noise_order) : FitJson()},
                 {"runs_probability", fit.runs_p},
                 {"half_depth_modulus_Pa", fit.half_depth_modulus_pa ? FitJson(*fit.half_depth_modulus_pa) : FitJson()},
                 {"trust", fits::name_of(fit.trust)}};
  result["doubts"] = FitJson::array();
  for (const fits::Found& found : fit.doubts) {
    result["doubts"].push_back({{"reason", fits::kDoubts.at(static_cast<std::size_t>(found.doubt)).name},
                                {"figure", found.figure},
                                {"limit", found.limit}});
  }
  return result;
}

curves::SvgLine fit_line(const curves::AnalysedCurve& curve, const fits::ElasticFit& fit) {
  curves::SvgLine line{"fit", std::string(curves::distinct_color(2)), curves::LineStyle::Solid, {}};
  const double zero_m = curve.features.contact_point.value_or(physics::Length()).si;
  std::size_t at = 0;
  for (const physics::CurvePoint& point : curve.curve.points) {
    if (point.branch != physics::Branch::Approach || at == fit.model_n.size()) continue;
    line.points.push_back({(point.z.si - zero_m) * curves::kNmPerM,
                           (fit.model_n[at++] - curve.features.baseline.at(point.z).si) * curves::kNnPerN});
  }
  return line;
}

}  // namespace afm::app
