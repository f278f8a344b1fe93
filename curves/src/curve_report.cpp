// SPDX-License-Identifier: Apache-2.0
#include "curves/curve_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "core/printable.h"
#include "core/written_by.h"
#include "curves/plot_units.h"
#include "fits/elastic_fit.h"
#include "physics/quantity_text.h"

namespace afm::curves {

namespace {

using physics::CurveFeatures;
using json = nlohmann::ordered_json;

// One line of the report and one key of the JSON.
struct Figure {
  const char* key;    // key in JSON, with the unit
  const char* title;  // title for users
  std::optional<double> (*si)(const CurveFeatures& features);
  std::string (*text)(double si);
};

template <auto& Units, class Q>
std::string text_of(double si) {
  return physics::format_quantity(Q(si), Units, 4);
}

constexpr auto kLengthText = &text_of<physics::kLengthUnits, physics::Length>;
constexpr auto kForceText = &text_of<physics::kForceUnits, physics::Force>;
constexpr auto kStiffnessText = &text_of<physics::kStiffnessUnits, physics::Stiffness>;
constexpr auto kEnergyText = &text_of<physics::kEnergyUnits, physics::Energy>;

double zero_of(const CurveFeatures& features) { return features.contact_point.value_or(physics::Length()).si; }

bool has_waves(const CurveFeatures& features) { return features.baseline.waves.period.si > 0.0; }

// Figures in printing order.
const Figure kFigures[] = {
    {"baseline_level_N", "baseline", [](const CurveFeatures& f) { return std::optional(f.baseline.level.si); },
     kForceText},
    {"baseline_tilt_N_per_m", "  its tilt", [](const CurveFeatures& f) { return std::optional(f.baseline.tilt.si); },
     kStiffnessText},
    {"baseline_noise_N", "  its noise", [](const CurveFeatures& f) { return std::optional(f.baseline.noise.si); },
     kForceText},
    {"baseline_waves_N", "  its waves",
     [](const CurveFeatures& f) {
       return has_waves(f) ? std::optional(f.baseline.waves.amplitude().si) : std::nullopt;
     },
     kForceText},
    {"baseline_wave_period_m", "  their period",
     [](const CurveFeatures& f) { return has_waves(f) ? std::optional(f.baseline.waves.period.si) : std::nullopt; },
     kLengthText},
    {"contact_point_m", "contact point",
     [](const CurveFeatures& f) { return f.contact_point ? std::optional(f.contact_point->si) : std::nullopt; },
     kLengthText},
    {"snap_in_z_m", "snap-in at",
     [](const CurveFeatures& f) { return f.snap_in ? std::optional(f.snap_in->z.si - zero_of(f)) : std::nullopt; },
     kLengthText},
    {"snap_in_force_before_N", "  from",
     [](const CurveFeatures& f) { return f.snap_in ? std::optional(f.snap_in->force_before.si) : std::nullopt; },
     kForceText},
    {"snap_in_force_after_N", "  to",
     [](const CurveFeatures& f) { return f.snap_in ? std::optional(f.snap_in->force_after.si) : std::nullopt; },
     kForceText},
    {"pull_off_z_m", "pull-off at",
     [](const CurveFeatures& f) { return f.pull_off ? std::optional(f.pull_off->z.si - zero_of(f)) : std::nullopt; },
     kLengthText},
    {"pull_off_force_N", "  force",
     [](const CurveFeatures& f) { return f.pull_off ? std::optional(f.pull_off->force.si) : std::nullopt; },
     kForceText},
    {"adhesion_force_N", "hardest pull",
     [](const CurveFeatures& f) { return f.adhesion ? std::optional(f.adhesion->force.si) : std::nullopt; },
     kForceText},
    {"greatest_push_N", "greatest push", [](const CurveFeatures& f) { return std::optional(f.greatest_push.si); },
     kForceText},
    {"contact_slope_N_per_m", "contact slope",
     [](const CurveFeatures& f) { return f.contact_slope ? std::optional(f.contact_slope->si) : std::nullopt; },
     kStiffnessText},
    {"loop_energy_J", "loop energy", [](const CurveFeatures& f) { return std::optional(f.loop_energy.si); },
     kEnergyText},
    {"adhesion_energy_J", "adhesion energy", [](const CurveFeatures& f) { return std::optional(f.adhesion_energy.si); },
     kEnergyText},
};

std::optional<double> difference(const std::optional<double>& measured, const std::optional<double>& other) {
  if (!measured || !other) return std::nullopt;
  return *measured - *other;
}

// Methods that found a contact point, from the deepest to the outermost.
template <class Out>
void add_contact_method(const CurveFeatures& features, Out out) {
  const physics::PlaceRange range = *features.contact_range;
  fmt::format_to(out, "{:<16}{:>16}  (all methods: {} to {})\n", "  its method", name_of(features.contact_method),
                 kLengthText(range.low.si), kLengthText(range.high.si));
  if (features.contact_doubtful) {
    fmt::format_to(out,
                   "  DOUBTFUL: too short or too wavy a baseline, or methods that differ by more than a third of the "
                   "pushed depth; look at the curve (--out), record more of it before contact, or choose a method with "
                   "--contact-point\n");
  }
}

// False for the zeros of an instrument's height and detector, which are not properties of the contact.
bool is_comparable(const Figure& figure) {
  return std::string_view(figure.key) != "contact_point_m" && !std::string_view(figure.key).starts_with("baseline");
}

std::string described(const RecordedCurve& curve) {
  const CurveMetadata& from = curve.metadata;
  const auto approach = std::count_if(curve.points.begin(), curve.points.end(),
                                      [](const auto& point) { return point.branch == physics::Branch::Approach; });
  std::string text =
      fmt::format("{} points down, {} up", approach, static_cast<std::ptrdiff_t>(curve.points.size()) - approach);
  if (from.spring_constant) text += ", " + kStiffnessText(from.spring_constant->si);
  for (const std::string* part : {&from.curve_id, &from.instrument, &from.date}) {
    if (!part->empty()) text += ", " + *part;
  }
  return text;
}

// Adds a remark if the tip is pulled at the deepest twentieth of the approach, where it should be pushed.
void remark_sign(const CurveFeatures& features, RecordedCurve& curve) {
  constexpr double kSignificant = 5.0, kRoundingShare = 1e-6, kDeepestShare = 0.05;
  std::vector<physics::CurvePoint> approach;
  std::copy_if(curve.points.begin(), curve.points.end(), std::back_inserter(approach),
               [](const auto& point) { return point.branch == physics::Branch::Approach; });
  const auto [low, high] =
      std::minmax_element(approach.begin(), approach.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  const physics::Length deepest = low->z + kDeepestShare * (high->z - low->z);
  std::vector<double> forces;
  double greatest_n = 0.0;
  for (const physics::CurvePoint& point : approach) {
    greatest_n = std::max(greatest_n, std::abs(point.force.si));
    if (point.z <= deepest) forces.push_back((point.force - features.baseline.at(point.z)).si);
  }
  const auto middle = forces.begin() + static_cast<std::ptrdiff_t>(forces.size() / 2);
  std::nth_element(forces.begin(), middle, forces.end());
  const double threshold_n = std::max(kSignificant * features.baseline.noise.si, kRoundingShare * greatest_n);
  if (!(-*middle > threshold_n) || -*middle < features.greatest_push.si) return;
  curve.metadata.remarks.push_back(
      fmt::format("at its deepest the tip is pulled by {}, where it should be pushed: is the sign of the sensitivity "
                  "wrong?",
                  kForceText(-*middle)));
}

// Adds a remark if the greatest force of the approach lasts, as at the end of the detector's range: the contact goes
// on.
void remark_detector_end(const CurveFeatures& features, RecordedCurve& curve) {
  std::vector<fits::Sample> approach;
  for (const physics::CurvePoint& point : curve.points) {
    if (point.branch != physics::Branch::Approach) continue;
    approach.push_back({point.z.si, (point.force - features.baseline.level).si});
  }
  const double push_n = features.greatest_push.si, noise_n = features.baseline.noise.si;
  constexpr double kRoundingShare = 1e-9, kNoiseShare = 0.5;
  if (!(push_n > fits::row_of(fits::Doubt::NeverPushed).limit * noise_n)) return;
  const double lasts =
      fits::points_at_greatest_force(approach, std::max(kRoundingShare * push_n, kNoiseShare * noise_n));
  if (!(lasts > fits::row_of(fits::Doubt::Saturated).limit)) return;
  curve.metadata.remarks.push_back(
      fmt::format("the greatest force of the approach, {}, lasts while the base goes on: does the detector end there? "
                  "Contact point and contact slope are then wrong",
                  kForceText(push_n)));
}

// Name of the zero of the places in a report.
const char* zero_name(const CurveFeatures& features) {
  return features.contact_point ? "the contact point" : "the zero of the file's own heights";
}

// False for places with different kinds of zero.
bool is_subtractable(const Figure& figure, const CurveFeatures& a, const CurveFeatures& b) {
  return a.contact_point.has_value() == b.contact_point.has_value() || !std::string_view(figure.key).ends_with("_z_m");
}

}  // namespace

core::Result<AnalysedCurve> analysed(std::string name, RecordedCurve curve,
                                     std::optional<physics::ContactMethod> method,
                                     const physics::BaselineChoice& baseline) {
  try {
    const bool computed = curve.metadata.software == kComputedBy;
    CurveFeatures features = physics::analyse(
        curve.points, computed ? physics::ForceZero::True : physics::ForceZero::Instrument, method, baseline);
    if (method && !features.contact_point) {
      return core::failure(core::ErrorCategory::BadInputFile,
                           fmt::format("cannot analyse {}: --contact-point {} finds no contact point; try another",
                                       name, physics::name_of(*method)));
    }
    if (!computed) {
      remark_sign(features, curve);
      remark_detector_end(features, curve);
    }
    return AnalysedCurve{std::move(name), std::move(curve), features};
  } catch (const std::invalid_argument& error) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("cannot analyse {}: {}", name, error.what()));
  }
}

std::string features_text(const AnalysedCurve& measured, const AnalysedCurve* other) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{}: {}\n", core::printable_line(measured.name), described(measured.curve));
  for (const std::string& remark : measured.curve.metadata.remarks) fmt::format_to(out, "remark: {}\n", remark);
  if (other != nullptr) fmt::format_to(out, "{:<16}{:>16}{:>16}{:>16}\n", "", "measured", other->name, "difference");
  for (const Figure& figure : kFigures) {
    const auto cell = [&](const std::optional<double>& si) {
      return si ? figure.text(*si + 0.0) : std::string("none");
    };
    const auto value = figure.si(measured.features);
    fmt::format_to(out, "{:<16}{:>16}", figure.title, cell(value));
    if (other != nullptr && is_comparable(figure)) {
      const auto expected = figure.si(other->features);
      fmt::format_to(out, "{:>16}{:>16}", cell(expected),
                     cell(is_subtractable(figure, measured.features, other->features) ? difference(value, expected)
                                                                                      : std::nullopt));
    }
    text.push_back('\n');
    if (std::string_view(figure.key) == "contact_point_m" && value) add_contact_method(measured.features, out);
  }
  fmt::format_to(out, "places are from {}; forces are above the baseline, positive away from the sample\n",
                 zero_name(measured.features));
  if (other != nullptr && other->features.contact_point.has_value() != measured.features.contact_point.has_value()) {
    fmt::format_to(out, "places of {} are from {}\n", other->name, zero_name(other->features));
  }
  return fmt::to_string(text);
}

json features_json(const AnalysedCurve& measured, const AnalysedCurve* other) {
  const auto value_or_null = [](const std::optional<double>& si) { return si ? json(*si + 0.0) : json(); };
  const CurveMetadata& from = measured.curve.metadata;
  json result{{"curve", measured.name},
              {"points", measured.curve.points.size()},
              {"spring_constant_N_per_m", from.spring_constant ? json(from.spring_constant->si) : json()}};
  for (const Figure& figure : kFigures) result[figure.key] = value_or_null(figure.si(measured.features));
  result["contact_point_method"] =
      measured.features.contact_point ? json(name_of(measured.features.contact_method)) : json();
  result["contact_point_doubtful"] = measured.features.contact_doubtful;
  const auto& range = measured.features.contact_range;
  result["contact_point_range_m"] = range ? json::array({range->low.si, range->high.si}) : json();
  result["places_are_from"] = zero_name(measured.features);
  result["remarks"] = from.remarks;
  for (std::size_t i = 0; i < physics::kContactMethods.size(); ++i) {
    const auto& estimate = measured.features.contact_estimates[i];
    result["contact_point_methods_m"][std::string(physics::kContactMethods[i].name)] =
        estimate ? json(estimate->si) : json();
  }
  if (!from.parameters.empty()) {
    json& parameters = result["parameters"];
    for (const auto& [key, value] : from.parameters) {
      const auto number = number_of(value);
      parameters[key] = number && std::isfinite(*number) ? json(*number) : json(value);
    }
  }
  core::name_software(result);
  if (other == nullptr) return result;
  result["beside"]["name"] = other->name;
  for (const Figure& figure : kFigures) {
    if (!is_comparable(figure)) continue;
    const auto expected = figure.si(other->features);
    result["beside"][figure.key] = value_or_null(expected);
    result["difference"][figure.key] = is_subtractable(figure, measured.features, other->features)
                                           ? value_or_null(difference(figure.si(measured.features), expected))
                                           : json();
  }
  return result;
}

std::vector<SvgLine> curve_lines(const AnalysedCurve& curve, const std::string& color) {
  SvgLine approach{curve.name + ", approach", color, LineStyle::Dashed, {}};
  SvgLine retract{curve.name + ", retract", color, LineStyle::Solid, {}};
  const double zero = zero_of(curve.features);
  for (const physics::CurvePoint& point : curve.curve.points) {
    SvgLine& line = point.branch == physics::Branch::Approach ? approach : retract;
    line.points.push_back(
        {(point.z.si - zero) * kNmPerM, (point.force - curve.features.baseline.at(point.z)).si * kNnPerN});
  }
  return {std::move(approach), std::move(retract)};
}

SvgPlot features_plot(const AnalysedCurve& measured, const AnalysedCurve* other) {
  SvgPlot plot;
  plot.title = other == nullptr ? measured.name : fmt::format("{} and {}", measured.name, other->name);
  plot.about = features_text(measured, other);
  plot.x_label = fmt::format("Z from {} (nm)", zero_name(measured.features));
  plot.y_label = "force on the tip (nN)";
  plot.lines = curve_lines(measured, std::string(distinct_color(0)));
  if (other != nullptr) {
    for (SvgLine& line : curve_lines(*other, std::string(distinct_color(1)))) plot.lines.push_back(std::move(line));
  }
  const CurveFeatures& found = measured.features;
  const auto mark = [&](physics::Length z, physics::Force force, const char* what) {
    plot.marks.push_back({{(z.si - zero_of(found)) * kNmPerM, force.si * kNnPerN},
                          fmt::format("{} {}", what, kForceText(force.si)),
                          std::string(distinct_color(0)),
                          SvgMark::Side::Right});
  };
  if (found.snap_in) mark(found.snap_in->z, found.snap_in->force_after, "snap-in");
  if (found.pull_off) mark(found.pull_off->z, found.pull_off->force, "pull-off");
  return plot;
}

}  // namespace afm::curves
