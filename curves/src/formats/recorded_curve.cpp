// SPDX-License-Identifier: Apache-2.0
#include "curves/recorded_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "bytes/text_table.h"
#include "core/printable.h"
#include "core/version.h"

namespace afm::curves {

RecordedCurve recorded_curve(const physics::ForceCurve& curve, physics::Stiffness spring_constant) {
  RecordedCurve recorded{physics::points_of(curve.samples), {}, {}};
  recorded.metadata.spring_constant = spring_constant;
  recorded.metadata.instrument = "TouchAFM";
  recorded.metadata.software = kComputedBy;
  recorded.metadata.software_version = core::kVersion;
  return recorded;
}

std::string doubt_of(const physics::CurvePoint& point) {
  constexpr double kHighestM = 1.0, kStrongestN = 1.0;
  if (std::abs(point.z.si) <= kHighestM && std::abs(point.force.si) <= kStrongestN) return "";
  return fmt::format("at {} m with {} N is outside the range of a force microscope; is it in SI?", point.z.si,
                     point.force.si);
}

bool is_map_of(std::size_t curves, const MapGrid& grid) {
  constexpr std::size_t kSmall = std::size_t{512} * 512, kPixelsACurve = 16;
  return grid.columns * grid.rows <= std::max(kSmall, kPixelsACurve * curves);
}

std::optional<MapPixel> pixel_at(const CurvePosition& position, const MapGrid& grid, double turn_rad, bool reflected) {
  const double x = position.x_m - grid.center_x_m, y = position.y_m - grid.center_y_m;
  const double u = std::cos(turn_rad) * x + std::sin(turn_rad) * y;
  const double v = (std::cos(turn_rad) * y - std::sin(turn_rad) * x) * (reflected ? -1.0 : 1.0);
  const double column = std::floor((u / grid.width_m + 0.5) * static_cast<double>(grid.columns));
  const double row = std::floor((v / grid.height_m + 0.5) * static_cast<double>(grid.rows));
  if (!(column >= 0.0 && column < static_cast<double>(grid.columns))) return std::nullopt;
  if (!(row >= 0.0 && row < static_cast<double>(grid.rows))) return std::nullopt;
  return MapPixel{grid, static_cast<std::size_t>(column), static_cast<std::size_t>(row)};
}

void add_parameter(std::string_view line, CurveMetadata& metadata) {
  constexpr std::size_t kMostParameters = 200, kLongest = 2000;
  const std::size_t colon = line.find(": ");
  if (colon == std::string_view::npos || line.size() > kLongest || metadata.parameters.size() == kMostParameters)
    return;
  // leaves room for the rest of a heading within the bytes by which a format is detected
  constexpr std::size_t kLongestOfAll = 32768;
  std::size_t all = line.size();
  for (const auto& parameter : metadata.parameters) all += parameter.first.size() + parameter.second.size();
  if (all > kLongestOfAll) return;
  const std::string key = core::printable_line(trimmed(line.substr(0, colon)));
  const std::string value = core::printable_line(trimmed(line.substr(colon + 2)));
  if (!key.empty() && !value.empty()) metadata.parameters.emplace_back(key, value);
}

std::optional<double> number_of(std::string_view value) {
  double number = 0.0;
  if (value.starts_with('+') && !value.starts_with("+-")) value.remove_prefix(1);
  const char* const begin = value.data();
  const char* const end = begin + value.size();
  const auto read = std::from_chars(begin, end, number);
  return read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

}  // namespace afm::curves
