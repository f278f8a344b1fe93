// SPDX-License-Identifier: Apache-2.0
#include "nhf_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>

#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr hsize_t kMostLinks = 1000;

// Least and largest value of a channel's integers, by the name of their type or, in version 1, its number. Version 2
// keeps one value for "not measured".
struct TypeRow {
  std::string_view name;
  int number;
  double bits;
  bool is_signed;
};
constexpr std::array kTypes{TypeRow{"int32", 0, 32, true},   TypeRow{"uint8", 1, 8, false},
                            TypeRow{"uint16", 2, 16, false}, TypeRow{"uint32", 3, 32, false},
                            TypeRow{"uint64", 4, 64, false}, TypeRow{"int16", 5, 16, true},
                            TypeRow{"int64", 6, 64, true}};

// Unit in the brackets of a name: m for "Meter (m)".
std::string_view unit_in(std::string_view text) {
  const std::size_t open = text.find('('), close = text.rfind(')');
  return open == std::string_view::npos || close == std::string_view::npos || close < open
             ? text
             : text.substr(open + 1, close - open - 1);
}

}  // namespace

std::optional<std::string> text_attribute(hid_t at, const char* name) {
  if (H5Aexists(at, name) <= 0) return std::nullopt;
  const Handle attribute = must(H5Aopen(at, name, H5P_DEFAULT), "open an attribute");
  const Handle type = must(H5Aget_type(attribute.get()), "read a type"),
               space = must(H5Aget_space(attribute.get()), "read a space");
  if (H5Tget_class(type.get()) != H5T_STRING || H5Sget_simple_extent_npoints(space.get()) != 1) return std::nullopt;
  return text_of(attribute.get(), type.get());
}

std::vector<double> numbers_attribute(hid_t at, const char* name) {
  constexpr hssize_t kMost = 16;
  if (H5Aexists(at, name) <= 0) return {};
  const Handle attribute = must(H5Aopen(at, name, H5P_DEFAULT), "open an attribute");
  const Handle type = must(H5Aget_type(attribute.get()), "read a type"),
               space = must(H5Aget_space(attribute.get()), "read a space");
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  const H5T_class_t kind = H5Tget_class(type.get());
  if ((kind != H5T_INTEGER && kind != H5T_FLOAT) || count < 1 || count > kMost) return {};
  std::vector<double> numbers(static_cast<std::size_t>(count));
  if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, numbers.data()) < 0) return {};
  return numbers;
}

std::optional<double> number_attribute(hid_t at, const char* name) {
  const std::vector<double> numbers = numbers_attribute(at, name);
  return numbers.size() == 1 && std::isfinite(numbers[0]) ? std::optional(numbers[0]) : std::nullopt;
}

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  std::array<char, 256> name{};
  for (hsize_t i = 0; i < kMostLinks; ++i) {
    // fails beyond the last one
    if (H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT) < 0) break;
    names.emplace_back(name.data());
  }
  return names;
}

Handle group_in(hid_t parent, const std::string& name) {
  return Handle(has(parent, name.c_str()) ? H5Gopen2(parent, name.c_str(), H5P_DEFAULT) : H5I_INVALID_HID);
}

Handle dataset_in(hid_t parent, const std::string& name) {
  return Handle(has(parent, name.c_str()) ? H5Dopen2(parent, name.c_str(), H5P_DEFAULT) : H5I_INVALID_HID);
}

double nhf_version(hid_t file) {
  const auto version = number_attribute(file, "nsf_file_version_major");
  if (version && (*version == 1.0 || *version == 2.0)) return *version;
  throw CurveError(fmt::format("it is a Nanosurf file of version {:g}; 1 and 2 are read", version.value_or(0.0)));
}

std::string nhf_kind(hid_t group) {
  const auto kind = text_attribute(group, "group_type"), old_kind = text_attribute(group, "measurement_type");
  return kind.value_or(old_kind.value_or(""));
}

std::string nhf_segment(hid_t segment) {
  const auto name = text_attribute(segment, "segment_name"), old_name = text_attribute(segment, "name");
  return name.value_or(old_name.value_or(""));
}

std::string nhf_channel(hid_t channel) {
  const auto name = text_attribute(channel, "signal_name"), old_name = text_attribute(channel, "name");
  return name.value_or(old_name.value_or(""));
}

void read_nhf_grid(hid_t at, NhfGrid& grid) {
  const auto take = [&](const char* name, double& to) {
    if (const auto number = number_attribute(at, name)) to = *number;
  };
  take("image_points_per_line", grid.columns);
  take("image_number_of_lines", grid.rows);
  take("grid_number_of_columns", grid.columns);
  take("grid_number_of_rows", grid.rows);
  take("image_size_x", grid.width_m);
  take("image_size_y", grid.height_m);
  take("grid_width", grid.width_m);
  take("grid_height", grid.height_m);
  const std::vector<double> size = numbers_attribute(at, "rect_axis_size"),
                            range = numbers_attribute(at, "rect_axis_range");
  if (size.size() == 2) std::tie(grid.rows, grid.columns) = std::pair(size[0], size[1]);
  if (range.size() == 2) std::tie(grid.height_m, grid.width_m) = std::pair(range[0], range[1]);
}

NhfCalibration nhf_calibration(hid_t channel, bool has_fill_value) {
  NhfCalibration found;
  const auto named = text_attribute(channel, "dataset_element_type");
  const auto numbered = number_attribute(channel, "dataset_element_type");
  const auto row = std::find_if(kTypes.begin(), kTypes.end(), [&](const TypeRow& each) {
    return named ? each.name == *named : numbered && *numbered == each.number;
  });
  if (row != kTypes.end()) {
    const double kept = has_fill_value ? 1.0 : 0.0;
    const double half = std::exp2(row->bits - 1.0);
    found.least = row->is_signed ? -half + kept : 0.0;
    found.most = row->is_signed ? half - 1.0 : 2.0 * half - 1.0 - kept;
  } else if (named.value_or("") != "double" && numbered.value_or(0.0) != 7.0) {
    throw CurveError("the type of its numbers is not known");
  }
  const bool old = H5Aexists(channel, "base_calibration_unit") > 0;
  const auto lowest = number_attribute(channel, old ? "base_calibration_min" : "signal_calibration_min");
  const auto highest = number_attribute(channel, old ? "base_calibration_max" : "signal_calibration_max");
  const auto unit = text_attribute(channel, old ? "base_calibration_unit" : "signal_calibration_unit");
  if (!lowest || !highest || !unit) throw CurveError("it has no calibration");
  found.lowest = *lowest;
  found.highest = *highest;
  found.unit = scaled_unit(unit_in(*unit));
  return found;
}

}  // namespace afm::curves
