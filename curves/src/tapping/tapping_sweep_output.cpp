// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/written_by.h"
#include "curves/curve_output.h"
#include "curves/plot_units.h"
#include "curves/tapping/tapping_output.h"
#include "curves/tapping/tapping_sweep.h"
#include "tapping/tap_regimes.h"

namespace afm::curves {
namespace {

using json = nlohmann::ordered_json;

bool is_swept(const TappingSweep& sweep, std::string_view option) {
  return std::any_of(sweep.axes.begin(), sweep.axes.end(),
                     [&](const SweepAxis& axis) { return axis.parameter->option == option; });
}

// Value for drawing: a length in nm, everything else in SI.
double drawn(const SweepAxis& axis, double si) {
  return axis.parameter->sort == physics::kLengthUnits.sort ? si * kNmPerM : si;
}
std::string label_of(const SweepAxis& axis) {
  if (axis.parameter->sort != physics::kLengthUnits.sort) return std::string(axis.parameter->json_key);
  std::string name(axis.parameter->option == "z" ? "piezo displacement Z" : axis.parameter->option);
  std::replace(name.begin(), name.end(), '-', ' ');
  return name + " (nm)";
}
AxisScale scale_of(const SweepAxis& axis) { return axis.logarithmic ? AxisScale::Logarithmic : AxisScale::Linear; }

std::string title_of(const TappingSweep& sweep) { return sweep.setup.heading() + ", regimes of tapping"; }

// Adds the dots of two axes, with the regimes as empty lines of the legend.
void add_dots(const TappingSweep& sweep, SvgPlot& plot) {
  const auto regimes = regimes_of(sweep);
  for (std::size_t i = 0; i < regimes.size(); ++i) {
    plot.lines.push_back({std::string(regimes[i].word), std::string(distinct_color(i)), LineStyle::Solid, {}});
  }
  plot.y_label = label_of(sweep.axes[1]);
  plot.y_scale = scale_of(sweep.axes[1]);
  for (const TapSweepRow& row : sweep.rows) {
    const auto found = std::find_if(regimes.begin(), regimes.end(),
                                    [&](const RegimeRow& regime) { return regime.word == row.regime; });
    if (found == regimes.end()) continue;
    const auto index = static_cast<std::size_t>(found - regimes.begin());
    plot.marks.push_back({{drawn(sweep.axes[0], row.at[0]), drawn(sweep.axes[1], row.at[1])},
                          "",
                          std::string(distinct_color(index)),
                          SvgMark::Side::Right});
  }
}

// Adds the lines of one axis: both values of a kind that a point may have.
void add_lines(const TappingSweep& sweep, SvgPlot& plot) {
  const auto columns = columns_of(sweep);
  const auto add = [&](std::string_view column, const char* label, std::size_t color) {
    const auto index = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin());
    SvgLine line{label, std::string(distinct_color(color)), LineStyle::Solid, {}};
    for (const TapSweepRow& row : sweep.rows) {
      line.points.push_back({drawn(sweep.axes[0], row.at[0]), row.values.at(index) * kNmPerM});
    }
    plot.lines.push_back(std::move(line));
  };
  if (sweep.at_heights) {
    plot.y_label = "amplitude A, zero-to-peak (nm)";
    add("attractive_amplitude_m", "attractive", 0);
    add("repulsive_amplitude_m", "repulsive", 1);
  } else {
    plot.y_label = "piezo displacement Z of the jump (nm)";
    add("jump_in_z_m", "into the repulsive state, on the way down", 0);
    add("jump_off_z_m", "out of it, on the way up", 1);
  }
}

// Program, parameters, sources and swept ranges.
std::string header_of(const TappingSweep& sweep) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# software: {}\n{}", core::written_by(),
                 setup_header(sweep.setup, swept_parameters(sweep.axes)));
  const TappingOptions& numbers = sweep.choice.numbers;
  if (!is_swept(sweep, "free-amplitude")) fmt::format_to(out, "# free amplitude: {}\n", numbers.free_amplitude);
  if (!numbers.drive.empty()) fmt::format_to(out, "# drive: {}\n", numbers.drive);
  if (!numbers.viscosity.empty()) fmt::format_to(out, "# viscosity: {}\n", numbers.viscosity);
  for (const SweepAxis& axis : sweep.axes) {
    fmt::format_to(out, "# swept: {} from {} to {}, {} values{}\n", axis.parameter->json_key, axis.from, axis.to,
                   axis.count, axis.logarithmic ? ", equal ratios" : "");
  }
  return fmt::to_string(text);
}

}  // namespace

std::string tapping_sweep_csv(const TappingSweep& sweep) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# TouchAFM tapping sweep\n{}", header_of(sweep));
  const json conventions = tapping_conventions();
  for (const auto& [key, meaning] : conventions.items()) {
    fmt::format_to(out, "# {}: {}\n", key, meaning.get<std::string>());
  }
  for (const RegimeRow& row : regimes_of(sweep)) fmt::format_to(out, "# regime {}: {}\n", row.word, row.meaning);
  for (const SweepAxis& axis : sweep.axes) fmt::format_to(out, "{},", axis.parameter->json_key);
  fmt::format_to(out, "regime");
  for (const std::string_view column : columns_of(sweep)) fmt::format_to(out, ",{}", column);
  fmt::format_to(out, ",refusal\n");
  for (const TapSweepRow& row : sweep.rows) {
    for (std::size_t a = 0; a < sweep.axes.size(); ++a) fmt::format_to(out, "{},", row.at.at(a));
    fmt::format_to(out, "{}", row.regime);
    for (const double value : row.values) {
      text.push_back(',');
      if (!std::isnan(value)) fmt::format_to(out, "{}", value + 0.0);
    }
    std::string refusal = row.refusal;
    std::replace(refusal.begin(), refusal.end(), ',', ';');
    fmt::format_to(out, ",{}\n", refusal);
  }
  return fmt::to_string(text);
}

nlohmann::ordered_json tapping_sweep_json(const TappingSweep& sweep) {
  json result{{"model_requested", sweep.setup.model.text}, {"mode", "tapping"}, {"conventions", tapping_conventions()}};
  json& regimes = result["regimes"] = json::object();
  for (const RegimeRow& row : regimes_of(sweep)) regimes[std::string(row.word)] = row.meaning;
  json parameters = parameters_json(sweep.setup);
  for (const SweepAxis& axis : sweep.axes) parameters.erase(std::string(axis.parameter->json_key));
  const TappingOptions& numbers = sweep.choice.numbers;
  if (!is_swept(sweep, "free-amplitude")) parameters["free_amplitude"] = numbers.free_amplitude;
  if (!numbers.drive.empty()) parameters["drive"] = numbers.drive;
  if (!numbers.viscosity.empty()) parameters["viscosity"] = numbers.viscosity;
  result["parameters"] = std::move(parameters);
  json& points = result["points"] = json::array();
  const auto columns = columns_of(sweep);
  for (const TapSweepRow& row : sweep.rows) {
    json point = json::object();
    for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
      point[std::string(sweep.axes[a].parameter->json_key)] = row.at.at(a);
    }
    point["regime"] = row.regime.empty() ? json() : json(row.regime);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      point[std::string(columns[i])] = std::isfinite(row.values[i]) ? json(row.values[i] + 0.0) : json();
    }
    point["refusal"] = row.refusal.empty() ? json() : json(row.refusal);
    points.push_back(std::move(point));
  }
  add_sources(result, acting_sources(sweep.setup, swept_parameters(sweep.axes)));
  core::name_software(result);
  return result;
}

SvgPlot tapping_sweep_plot(const TappingSweep& sweep) {
  SvgPlot plot;
  plot.title = title_of(sweep);
  plot.about = header_of(sweep);
  plot.x_label = label_of(sweep.axes[0]);
  plot.x_scale = scale_of(sweep.axes[0]);
  if (sweep.axes.size() == 2) {
    add_dots(sweep, plot);
  } else {
    add_lines(sweep, plot);
  }
  return plot;
}

}  // namespace afm::curves
