// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "curves/angle_units.h"
#include "curves/fitting/curve_fit.h"
#include "curves/plot_units.h"
#include "fitting/fit_points.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

using physics::format_quantity;
using FitJson = nlohmann::ordered_json;

constexpr int kDigits = 4;

double atomic_distance_of(const FitOptions& options) {
  return options.atomic_distance_m.value_or(fits::Indenter{}.atomic_distance_m);
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
  if (shape.is_adhesive) text += ", z0 = " + length_text(atomic_distance_of(options));
  return text + fmt::format(", nu = {:g}", options.poisson);
}

using Line = std::function<void(const char* title, const std::string& value)>;

std::string work_text(double j_per_m2) {
  return format_quantity(physics::SurfaceEnergy(j_per_m2), physics::kSurfaceEnergyUnits, kDigits);
}

// Adds two lines below the interval of a quantity.
void bootstrap_lines(const fits::Interval& interval, std::string (*text)(double si), const Line& line) {
  line("  bootstrap from", text(interval.low));
  line("  to", text(interval.high));
}

void adhesion_lines(const fits::ElasticFit& fit, const Line& line) {
  const fits::Adhesion& adhesion = *fit.adhesion;
  line("work of adhesion", work_text(adhesion.work_j_per_m2));
  line("  95 % from", adhesion.work_interval.low > 0.0 ? work_text(adhesion.work_interval.low) : "not found");
  line("  to", std::isfinite(adhesion.work_interval.high) ? work_text(adhesion.work_interval.high) : "not found");
  if (fit.bootstrap) bootstrap_lines(fit.bootstrap->work_j_per_m2, work_text, line);
  line("pull-off", force_text(adhesion.pull_off_n));
  line("  at", length_text(adhesion.pull_off_z_m));
  line("Tabor parameter", fmt::format("{:.{}g}", adhesion.tabor, kDigits));
  line("law", std::string(fits::row_of(fit.shape).name));
  if (adhesion.rounds > 0) {
    line("  chosen by", "Tabor");
    line("  fits", fmt::format("{}", adhesion.rounds));
  }
}

void systematic_lines(const fits::ElasticFit& fit, const Line& line) {
  const fits::SystematicShares sum = fits::sum_of_shares(fit.systematic);
  // a refit may have failed
  const bool found = std::isfinite(sum.modulus) && std::isfinite(sum.work);
  line("systematic of E", found ? pressure_text(sum.modulus * fit.modulus_pa) : "not found");
  if (fit.adhesion) line("  of W", found ? work_text(sum.work * fit.adhesion->work_j_per_m2) : "not found");
  for (const fits::Systematic& each : fit.systematic) {
    const auto& [of, share] = each.uncertainty;
    const std::string title =
        fmt::format("  {} {:g} %: ", fits::kGiven.at(static_cast<std::size_t>(of)).name, 100.0 * share);
    if (!std::isfinite(each.modulus_share)) {
      line(title.c_str(), "not found");
      continue;
    }
    line(title.c_str(), fmt::format("E {:.3g} %", 100.0 * each.modulus_share) +
                            (fit.adhesion ? fmt::format(", W {:.3g} %", 100.0 * each.work_share) : ""));
  }
}

FitJson finite_json(double value) { return std::isfinite(value) ? FitJson(value) : FitJson(); }

FitJson bootstrap_json(const fits::ElasticFit& fit) {
  if (!fit.bootstrap) return {};
  const fits::Bootstrap& found = *fit.bootstrap;
  const fits::Interval& work = found.work_j_per_m2;
  return {{"modulus_95_percent_Pa", {found.modulus_pa.low, found.modulus_pa.high}},
          {"work_95_percent_J_per_m2", fit.adhesion ? FitJson({work.low, work.high}) : FitJson()},
          {"fits", found.fits},
          {"block_points", found.block}};
}

FitJson adhesion_json(const fits::ElasticFit& fit) {
  if (!fit.adhesion) return {};
  const fits::Adhesion& adhesion = *fit.adhesion;
  return {{"law", fits::row_of(fit.shape).name},
          {"rounds", adhesion.rounds > 0 ? FitJson(adhesion.rounds) : FitJson()},
          {"work_J_per_m2", adhesion.work_j_per_m2},
          {"work_95_percent_J_per_m2",
           {adhesion.work_interval.low > 0.0 ? FitJson(adhesion.work_interval.low) : FitJson(),
            finite_json(adhesion.work_interval.high)}},
          {"pull_off_N", adhesion.pull_off_n},
          {"pull_off_z_m", adhesion.pull_off_z_m},
          {"tabor", adhesion.tabor}};
}

FitJson systematic_json(const fits::ElasticFit& fit, const fits::SystematicShares& sum) {
  if (fit.systematic.empty()) return {};
  FitJson parts = FitJson::array();
  for (const fits::Systematic& each : fit.systematic) {
    parts.push_back({{"of", fits::kGiven.at(static_cast<std::size_t>(each.uncertainty.of)).name},
                     {"uncertainty", each.uncertainty.share},
                     {"modulus_share", finite_json(each.modulus_share)},
                     {"work_share", fit.adhesion ? finite_json(each.work_share) : FitJson()}});
  }
  return {{"modulus_Pa", finite_json(sum.modulus * fit.modulus_pa)},
          {"work_J_per_m2", fit.adhesion ? finite_json(sum.work * fit.adhesion->work_j_per_m2) : FitJson()},
          {"parts", parts}};
}

}  // namespace

std::string doubt_text(const fits::Found& found) {
  const fits::DoubtRow& row = fits::row_of(found.doubt);
  return fmt::format("{} {:.3g} (limit {:g}{})", row.name, found.figure, row.limit,
                     found.advised ? fmt::format("; try --fit {}", fits::row_of(*found.advised).name) : "");
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
  if (fit.bootstrap) bootstrap_lines(fit.bootstrap->modulus_pa, pressure_text, line);
  if (options.bootstrap && !fit.bootstrap) line("  bootstrap", "not found");
  line("reduced modulus", pressure_text(fit.reduced_modulus_pa));
  if (fit.adhesion) adhesion_lines(fit, line);
  if (!fit.systematic.empty()) systematic_lines(fit, line);
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
    fmt::format_to(out, "  {}\n", doubt_text(found));
  }
  fmt::format_to(
      out, "the interval covers only the noise; errors of spring constant, sensitivity and radius are separate{}\n",
      fit.systematic.empty() ? " (--uncertainty)" : ", in the systematic part");
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
                 {"atomic_distance_m", shape.is_adhesive ? FitJson(atomic_distance_of(options)) : FitJson()},
                 {"adhesion", adhesion_json(fit)},
                 {"bootstrap", bootstrap_json(fit)},
                 {"systematic", systematic_json(fit, fits::sum_of_shares(fit.systematic))},
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
    result["doubts"].push_back({{"reason", fits::row_of(found.doubt).name},
                                {"figure", finite_json(found.figure)},
                                {"limit", fits::row_of(found.doubt).limit},
                                {"advised", found.advised ? FitJson(fits::row_of(*found.advised).name) : FitJson()}});
  }
  return result;
}

SvgLine fit_line(const AnalysedCurve& curve, const fits::ElasticFit& fit, const FitOptions& options) {
  SvgLine line{"fit", std::string(distinct_color(2)), LineStyle::Solid, {}};
  const double zero_m = curve.features.contact_point.value_or(physics::Length()).si;
  const std::vector<std::size_t> places = fit_points(curve, options).places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    // broken where points are left out
    constexpr double kBreak = std::numeric_limits<double>::quiet_NaN();
    if (i > 0 && places[i] != places[i - 1] + 1) line.points.push_back({kBreak, kBreak});
    const physics::CurvePoint& point = curve.curve.points[places[i]];
    line.points.push_back(
        {(point.z.si - zero_m) * kNmPerM, (fit.model_n[i] - curve.features.baseline.line_at(point.z).si) * kNnPerN});
  }
  return line;
}

}  // namespace afm::curves
