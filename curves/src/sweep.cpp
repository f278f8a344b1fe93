// SPDX-License-Identifier: Apache-2.0
#include "curves/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "core/written_by.h"
#include "curves/curve_output.h"
#include "over_all_cores.h"
#include "physics/law_tables.h"

namespace afm::curves {
namespace {

using json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

tl::unexpected<core::Error> wrong_axis(const std::string& text, const std::string& why) {
  return core::wrong_usage(fmt::format("{}: {}", text.substr(0, 80), why));
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + 1) {
    parts.push_back(text.substr(begin, end - begin));
  }
  parts.push_back(text.substr(begin));
  return parts;
}

std::string sweepable(const ModelName& model, std::span<const ContactParameter> more) {
  std::string names;
  for (const ContactParameter& parameter : more) names += std::string(parameter.option) + ", ";
  const std::size_t own = names.size();
  for (const ContactParameter& parameter : contact_parameters()) {
    if (changes_force(parameter, model))
      names += fmt::format("{}{}", names.size() == own ? "" : ", ", parameter.option);
  }
  return names;
}

// Takes the figures of a law at rest.
void take_figures(const physics::CycleFigures& figures, SweepRow& row) {
  row.critical_stiffness_n_per_m = figures.critical_stiffness.si;
  row.loop_energy_j = figures.loop_energy.si;
  if (!figures.hysteretic) return;
  row.snap_in_z_m = figures.z_jtc.si;
  row.snap_in_force_before_n = figures.force_before_jtc.si;
  row.snap_in_force_after_n = figures.force_after_jtc.si;
  row.pull_off_z_m = figures.z_joc.si;
  row.pull_off_force_n = figures.force_before_joc.si;
}

// Takes the figures of a recorded curve.
void take_events(const CurveRun& run, SweepRow& row) {
  row.critical_stiffness_n_per_m = run.figures.critical_stiffness.si;
  const auto energy = loop_energy(run);
  row.loop_energy_j = energy ? energy->si : kNone;
  if (const auto* in = find_event(run.curve, physics::EventKind::JumpToContact)) {
    row.snap_in_z_m = in->z.si;
    row.snap_in_force_before_n = in->force_before.si;
    row.snap_in_force_after_n = in->force_after.si;
  }
  if (const auto* out = find_event(run.curve, physics::EventKind::JumpOffContact)) {
    row.pull_off_z_m = out->z.si;
    row.pull_off_force_n = out->force_before.si;
  }
}

SweepRow sweep_row(const ContactSetup& setup, const PathOptions& path) {
  SweepRow row;
  row.tabor = row.maugis = row.snap_in_z_m = row.snap_in_force_before_n = row.snap_in_force_after_n = row.pull_off_z_m =
      row.pull_off_force_n = row.loop_energy_j = row.critical_stiffness_n_per_m = kNone;
  try {
    row.model = setup.used_model();
    if (const auto place = setup.place()) {
      row.tabor = place->tabor;
      row.maugis = place->maugis;
      row.regime = physics::name_of(place->regime);
    }
    if (!setup.model.dynamic && !setup.model.direction_rule) {
      take_figures(physics::build_law_tables(setup.law(), setup.material.contact, setup.law_options)->figures, row);
      return row;
    }
    const auto run = run_curve(setup, path);
    if (run) {
      take_events(*run, row);
    } else {
      row.refusal = run.error().message;
    }
  } catch (const std::invalid_argument& error) {
    row.refusal = error.what();
  }
  return row;
}

ContactSetup at_point(ContactSetup setup, const std::vector<SweepAxis>& axes, const std::array<double, 2>& at) {
  for (std::size_t a = 0; a < axes.size(); ++a) {
    override_parameter(setup, *axes[a].parameter, at[a], format_parameter(*axes[a].parameter, at[a]), "--sweep");
  }
  return setup;
}

}  // namespace

double SweepAxis::value(std::uint64_t index) const {
  if (!values.empty()) return values[index];
  if (index + 1 == count) return to;
  const double share = static_cast<double>(index) / static_cast<double>(count - 1);
  return logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
}

core::Result<SweepAxis> parse_sweep_axis(const std::string& text, const ModelName& model,
                                         std::span<const ContactParameter> more) {
  const std::size_t equals = text.find('=');
  const auto parts = equals == std::string::npos ? std::vector<std::string>() : split(text.substr(equals + 1), ':');
  if (parts.size() != 3 && !(parts.size() == 4 && parts[3] == "log")) {
    return wrong_axis(text,
                      "write key=from:to:count, as in spring-constant=0.01N/m:1N/m:50, with :log for equal ratios");
  }
  SweepAxis axis;
  const std::string key = text.substr(0, equals);
  const auto beside = std::find_if(more.begin(), more.end(),
                                   [&](const ContactParameter& parameter) { return parameter.option == key; });
  axis.parameter = beside != more.end() ? &*beside : find_contact_parameter(key);
  if (axis.parameter == nullptr || (beside == more.end() && !changes_force(*axis.parameter, model))) {
    return wrong_axis(
        text, fmt::format("\"{}\" is not a number of the model {}; it has {}",
                          text.substr(0, std::min<std::size_t>(equals, 40)), model.text, sweepable(model, more)));
  }
  const auto from = parse_parameter(*axis.parameter, parts[0]);
  if (!from) return wrong_axis(text, from.error().message);
  const auto to = parse_parameter(*axis.parameter, parts[1]);
  if (!to) return wrong_axis(text, to.error().message);
  axis.from = *from;
  axis.to = *to;
  axis.logarithmic = parts.size() == 4;
  if (!std::isfinite(axis.from) || !std::isfinite(axis.to)) return wrong_axis(text, "both ends must be finite");
  if (axis.logarithmic && !(axis.from > 0.0 && axis.to > 0.0)) {
    return wrong_axis(text, "equal ratios need two positive ends");
  }
  const std::string& count = parts[2];
  const auto [end, status] = std::from_chars(count.data(), count.data() + count.size(), axis.count);
  if (status == std::errc::result_out_of_range) axis.count = std::numeric_limits<std::uint64_t>::max();
  if (status == std::errc::invalid_argument || end != count.data() + count.size() || axis.count < 2 ||
      axis.count > kLargestParameterSweep) {
    return wrong_axis(text, fmt::format("the count \"{}\" is not a whole number from 2 to {}", count.substr(0, 40),
                                        kLargestParameterSweep));
  }
  return axis;
}

core::Result<std::vector<SweepRow>> run_sweep(const ContactSetup& setup, const std::vector<SweepAxis>& axes,
                                              const PathOptions& path, const std::stop_token& stop) {
  std::uint64_t count = 1;
  for (const SweepAxis& axis : axes) count *= axis.count;  // product of at most two axes, so it cannot overflow
  if (count > kLargestParameterSweep) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("the sweep has {} points; at most {} may be", count, kLargestParameterSweep));
  }
  std::vector<SweepRow> rows(count);
  const std::uint64_t fastest = axes.back().count;
  over_all_cores(count, stop, [&](std::uint64_t i) {
    std::array<double, 2> at{axes.front().value(axes.size() == 1 ? i : i / fastest), 0.0};
    if (axes.size() == 2) at[1] = axes[1].value(i % fastest);
    rows[i] = sweep_row(at_point(setup, axes, at), path);
    rows[i].at = at;
  });
  if (stop.stop_requested()) return core::failure(core::ErrorCategory::Failed, "interrupted: the sweep is not whole");
  const bool none = std::all_of(rows.begin(), rows.end(), [](const SweepRow& row) { return !row.refusal.empty(); });
  if (none) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("no point of the sweep has a curve; the first: {}", rows.front().refusal));
  }
  return rows;
}

namespace {

struct Column {
  const char* name;
  double SweepRow::* value;
};

constexpr std::array<Column, 9> kColumns{{{"tabor_parameter", &SweepRow::tabor},
                                          {"maugis_lambda", &SweepRow::maugis},
                                          {"snap_in_z_m", &SweepRow::snap_in_z_m},
                                          {"snap_in_force_before_N", &SweepRow::snap_in_force_before_n},
                                          {"snap_in_force_after_N", &SweepRow::snap_in_force_after_n},
                                          {"pull_off_z_m", &SweepRow::pull_off_z_m},
                                          {"pull_off_force_N", &SweepRow::pull_off_force_n},
                                          {"loop_energy_J", &SweepRow::loop_energy_j},
                                          {"critical_stiffness_N_per_m", &SweepRow::critical_stiffness_n_per_m}}};

}  // namespace

std::vector<const ContactParameter*> swept_parameters(const std::vector<SweepAxis>& axes) {
  std::vector<const ContactParameter*> swept;
  swept.reserve(axes.size());
  for (const SweepAxis& axis : axes) swept.push_back(axis.parameter);
  return swept;
}

std::string sweep_csv(const ContactSetup& setup, const std::vector<SweepAxis>& axes,
                      const std::vector<SweepRow>& rows) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# TouchAFM sweep\n# software: {}\n{}", core::written_by(),
                 setup_header(setup, swept_parameters(axes)));
  for (const SweepAxis& axis : axes) {
    fmt::format_to(out, "# swept: {} from {} to {}, {} values{}\n", axis.parameter->json_key, axis.from, axis.to,
                   axis.count, axis.logarithmic ? ", equal ratios" : "");
  }
  fmt::format_to(
      out,
      "# signs: force on the tip positive away from the sample; empty where there is no jump; inf: hysteresis "
      "never vanishes\n");
  for (const SweepAxis& axis : axes) fmt::format_to(out, "{},", axis.parameter->json_key);
  fmt::format_to(out, "model,regime");
  for (const Column& column : kColumns) fmt::format_to(out, ",{}", column.name);
  fmt::format_to(out, ",refusal\n");
  for (const SweepRow& row : rows) {
    for (std::size_t a = 0; a < axes.size(); ++a) fmt::format_to(out, "{},", row.at[a]);
    fmt::format_to(out, "{},{}", row.model, row.regime);
    for (const Column& column : kColumns) {
      const double value = row.*column.value;
      if (std::isnan(value)) {
        fmt::format_to(out, ",");
      } else {
        fmt::format_to(out, ",{}", value + 0.0);  // adding zero turns -0 into 0
      }
    }
    std::string refusal = row.refusal;
    std::replace(refusal.begin(), refusal.end(), ',', ';');
    fmt::format_to(out, ",{}\n", refusal);
  }
  return fmt::to_string(text);
}

nlohmann::ordered_json sweep_json(const ContactSetup& setup, const std::vector<SweepAxis>& axes,
                                  const std::vector<SweepRow>& rows) {
  json points = json::array();
  for (const SweepRow& row : rows) {
    json point = json::object();
    for (std::size_t a = 0; a < axes.size(); ++a) point[std::string(axes[a].parameter->json_key)] = row.at[a];
    point["model"] = row.model;
    point["regime"] = row.regime.empty() ? json() : json(row.regime);
    for (const Column& column : kColumns) {
      const double value = row.*column.value;
      point[column.name] = std::isfinite(value) ? json(value + 0.0) : json();
    }
    point["refusal"] = row.refusal.empty() ? json() : json(row.refusal);
    points.push_back(std::move(point));
  }
  json parameters = parameters_json(setup);
  for (const SweepAxis& axis : axes) parameters.erase(std::string(axis.parameter->json_key));
  json result{
      {"model_requested", setup.model.text}, {"parameters", std::move(parameters)}, {"points", std::move(points)}};
  add_sources(result, acting_sources(setup, swept_parameters(axes)));
  core::name_software(result);
  return result;
}

}  // namespace afm::curves
