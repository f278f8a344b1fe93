// SPDX-License-Identifier: Apache-2.0
#include "formats/afmformats_metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "curves/curve_error.h"

namespace afm::curves {

namespace {

void read_text(const nlohmann::json& from, const char* key, std::string& text) {
  const auto found = from.find(key);
  if (found == from.end()) return;
  if (!found->is_string()) throw CurveError(fmt::format("its metadata \"{}\" is not a text", key));
  text = found->get<std::string>();
}

template <class Q>
void read_number(const nlohmann::json& from, const char* key, std::optional<Q>& value) {
  const auto found = from.find(key);
  if (found == from.end()) return;
  if (!found->is_number()) throw CurveError(fmt::format("its metadata \"{}\" is not a number", key));
  const double si = found->get<double>();
  if (!std::isfinite(si)) throw CurveError(fmt::format("its metadata \"{}\" is not finite", key));
  value = Q(si);
}

std::optional<std::size_t> count_of(const std::optional<double>& number, std::size_t most) {
  const bool is_count = number && *number >= 0.0 && *number <= static_cast<double>(most);
  return is_count ? std::optional(static_cast<std::size_t>(std::lround(*number))) : std::nullopt;
}

// Reads the position, and with a complete grid the pixel: by its indexes, or by the position as in afmformats.
void read_place(const nlohmann::json& from, CurveMetadata& metadata) {
  const auto number = [&from](const char* key) {
    std::optional<double> value;
    read_number(from, key, value);
    return value;
  };
  const auto x = number("position x"), y = number("position y");
  if (x && y) metadata.position = {*x, *y};
  const auto columns = count_of(number("grid shape x"), kMostMapSide),
             rows = count_of(number("grid shape y"), kMostMapSide);
  const auto width = number("grid size x"), height = number("grid size y");
  if (columns.value_or(0) == 0 || rows.value_or(0) == 0 || !(width && *width > 0.0 && height && *height > 0.0)) return;
  const MapGrid grid{
      *columns, *rows, *width, *height, number("grid center x").value_or(0.0), number("grid center y").value_or(0.0)};
  const auto column = count_of(number("grid index x"), *columns - 1), row = count_of(number("grid index y"), *rows - 1);
  if (column && row) {
    metadata.pixel = {grid, *column, *row};
  } else if (metadata.position) {
    metadata.pixel = pixel_at(*metadata.position, grid);
  }
}

}  // namespace

nlohmann::ordered_json afmformats_metadata(const RecordedCurve& curve) {
  const CurveMetadata& from = curve.metadata;
  nlohmann::ordered_json to{{"imaging mode", "force-distance"}, {"point count", curve.points.size()}};
  const auto put_text = [&](const char* key, const std::string& text) {
    if (!text.empty()) to[key] = text;
  };
  if (from.spring_constant) to["spring constant"] = from.spring_constant->si;
  if (from.sensitivity_m_per_v) to["sensitivity"] = *from.sensitivity_m_per_v;
  if (from.approach_speed) to["speed approach"] = from.approach_speed->si;
  if (from.retract_speed) to["speed retract"] = from.retract_speed->si;
  if (from.setpoint) to["setpoint"] = from.setpoint->si;
  const auto [low, high] = std::minmax_element(curve.points.begin(), curve.points.end(),
                                               [](const auto& a, const auto& b) { return a.z < b.z; });
  if (!curve.points.empty()) to["z range"] = (high->z - low->z).si;
  put_text("instrument", from.instrument);
  put_text("software", from.software);
  put_text("software version", from.software_version);
  put_text("date", from.date);
  put_text("time", from.time);
  put_text("curve id", from.curve_id);
  if (from.position) {
    to["position x"] = from.position->x_m;
    to["position y"] = from.position->y_m;
  }
  if (from.pixel) {
    const MapGrid& grid = from.pixel->grid;
    to["grid center x"] = grid.center_x_m;
    to["grid center y"] = grid.center_y_m;
    to["grid index x"] = from.pixel->column;
    to["grid index y"] = from.pixel->row;
    to["grid shape x"] = grid.columns;
    to["grid shape y"] = grid.rows;
    to["grid size x"] = grid.width_m;
    to["grid size y"] = grid.height_m;
  }
  return to;
}

void read_afmformats_metadata(const nlohmann::json& from, CurveMetadata& metadata) {
  if (!from.is_object()) throw CurveError("its metadata is not a JSON object");
  std::string mode = "force-distance";
  read_text(from, "imaging mode", mode);
  if (mode != "force-distance") {
    throw CurveError(fmt::format("its imaging mode is \"{}\"; only force-distance curves are read", mode));
  }
  read_number(from, "spring constant", metadata.spring_constant);
  read_number(from, "sensitivity", metadata.sensitivity_m_per_v);
  read_number(from, "speed approach", metadata.approach_speed);
  read_number(from, "speed retract", metadata.retract_speed);
  read_number(from, "setpoint", metadata.setpoint);
  read_text(from, "instrument", metadata.instrument);
  read_text(from, "software", metadata.software);
  read_text(from, "software version", metadata.software_version);
  read_text(from, "date", metadata.date);
  read_text(from, "time", metadata.time);
  read_text(from, "curve id", metadata.curve_id);
  read_place(from, metadata);
}

}  // namespace afm::curves
