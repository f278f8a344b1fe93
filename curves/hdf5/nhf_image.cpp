// SPDX-License-Identifier: Apache-2.0
#include "nhf_image.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "bytes/scaled_unit.h"
#include "curves/curve_error.h"
#include "hdf5_handles.h"
#include "images/image_pages.h"
#include "images/nhf_pages.h"

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

// An attribute with texts, or with numbers; empty without it.
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

// Points and size of an image. Version 2 has them as pairs, rows first.
struct Grid {
  double columns = 0, rows = 0, width_m = 0, height_m = 0;
};

void read_grid(hid_t at, Grid& grid) {
  const auto take = [&](const char* name, double& to) {
    if (const auto number = number_attribute(at, name)) to = *number;
  };
  take("image_points_per_line", grid.columns);
  take("image_number_of_lines", grid.rows);
  take("image_size_x", grid.width_m);
  take("image_size_y", grid.height_m);
  const std::vector<double> size = numbers_attribute(at, "rect_axis_size"),
                            range = numbers_attribute(at, "rect_axis_range");
  if (size.size() == 2) std::tie(grid.rows, grid.columns) = std::pair(size[0], size[1]);
  if (range.size() == 2) std::tie(grid.height_m, grid.width_m) = std::pair(range[0], range[1]);
}

bool is_image(hid_t group) {
  const auto kind = text_attribute(group, "group_type"), old_kind = text_attribute(group, "measurement_type");
  return kind.value_or(old_kind.value_or("")) == "image_line_based";
}

// "Meter (m)" becomes m.
std::string_view unit_in(std::string_view text) {
  const std::size_t open = text.find('('), close = text.rfind(')');
  return open == std::string_view::npos || close == std::string_view::npos || close < open
             ? text
             : text.substr(open + 1, close - open - 1);
}

struct Calibration {
  double least = 0, most = 1;      // range of the integers
  double lowest = 0, highest = 1;  // range of the values
  ScaledUnit unit;
};

Calibration calibration_of(hid_t channel, bool has_fill_value) {
  Calibration found;
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

std::vector<double> values_of(hid_t channel, std::size_t columns, std::size_t rows, const Calibration& calibration,
                              bool has_fill_value) {
  must_hold_its_data(channel, "of an image");
  const Handle space = must(H5Dget_space(channel), "read a space"), type = must(H5Dget_type(channel), "read a type");
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  const std::size_t points = columns * rows;
  if (count < 1 || static_cast<std::size_t>(count) > points || static_cast<std::size_t>(count) % columns != 0) {
    throw CurveError(fmt::format("it has {} points, not lines of {} up to {}", count, columns, points));
  }
  std::vector<double> numbers(static_cast<std::size_t>(count));
  if (H5Dread(channel, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0) {
    throw CurveError("it is damaged");
  }
  double unmeasured = std::numeric_limits<double>::quiet_NaN();
  if (has_fill_value) {
    const Handle made = must(H5Dget_create_plist(channel), "read how a data set was made");
    if (H5Pget_fill_value(made.get(), H5T_NATIVE_DOUBLE, &unmeasured) < 0) throw CurveError("it is damaged");
  }
  const double factor = (calibration.highest - calibration.lowest) / (calibration.most - calibration.least);
  numbers.resize(points, unmeasured);
  return grid_values(columns, rows, true, [&](std::size_t i) {
    if (std::isnan(numbers[i]) || numbers[i] == unmeasured) return std::numeric_limits<double>::quiet_NaN();
    return calibration.unit.factor * (calibration.lowest + factor * (numbers[i] - calibration.least));
  });
}

void add_channels(hid_t segment, bool has_fill_value, const std::string& direction, physics::ScanImage& image,
                  std::vector<UnreadChannel>& unread) {
  for (const std::string& link : names_in(segment)) {
    const Handle channel(has(segment, link.c_str()) ? H5Dopen2(segment, link.c_str(), H5P_DEFAULT) : H5I_INVALID_HID);
    if (!channel.is_open()) continue;
    auto name = text_attribute(channel.get(), "signal_name");
    if (!name) name = text_attribute(channel.get(), "name");
    if (!name || image.channels.size() + unread.size() == kMostChannels) continue;
    if (direction != "Forward") *name += fmt::format(" ({})", direction == "Backward" ? "retrace" : direction);
    try {
      const Calibration calibration = calibration_of(channel.get(), has_fill_value);
      image.channels.push_back({*name, calibration.unit.unit,
                                values_of(channel.get(), image.columns, image.rows, calibration, has_fill_value)});
    } catch (const CurveError& fault) {
      unread.push_back({*name, fault.what()});
    }
  }
}

}  // namespace

physics::ScanImage nhf_image(std::string_view bytes) {
  const Handle access = access_to_memory();
  // HDF5 copies the image
  must_do(H5Pset_file_image(access.get(), const_cast<char*>(bytes.data()), bytes.size()), "take the file");
  const Handle file(H5Fopen("image", H5F_ACC_RDONLY, access.get()));
  if (!file.is_open()) throw CurveError("it is damaged or cut short");
  const auto version = number_attribute(file.get(), "nsf_file_version_major");
  if (!version || (*version != 1.0 && *version != 2.0)) {
    throw CurveError(fmt::format("it is a Nanosurf file of version {:g}; 1 and 2 are read", version.value_or(0.0)));
  }
  for (const std::string& name : names_in(file.get())) {
    const Handle measurement = group_in(file.get(), name);
    if (!measurement.is_open() || !is_image(measurement.get())) continue;
    std::vector<std::string> segments;
    Grid grid;
    read_grid(measurement.get(), grid);
    for (const std::string& part : names_in(measurement.get())) {
      const Handle segment = group_in(measurement.get(), part);
      if (!segment.is_open()) continue;
      segments.push_back(part);
      if (grid.columns == 0.0 || grid.width_m == 0.0) read_grid(segment.get(), grid);
    }
    physics::ScanImage image;
    std::vector<UnreadChannel> unread;
    image.columns = image_side(grid.columns);
    image.rows = image_side(grid.rows);
    image.width_m = image_length_m(grid.width_m);
    image.height_m = image_length_m(grid.height_m);
    if (const auto label = text_attribute(measurement.get(), "measurement_name"))
      image.metadata.emplace_back("Name", *label);
    for (const std::string& part : segments) {
      const Handle segment = group_in(measurement.get(), part);
      auto direction = text_attribute(segment.get(), "segment_name");
      if (!direction) direction = text_attribute(segment.get(), "name");
      if (direction) add_channels(segment.get(), *version == 2.0, *direction, image, unread);
    }
    if (image.channels.empty()) {
      throw CurveError(unread.empty()
                           ? std::string("its image has no channels")
                           : fmt::format("its channel {} cannot be read: {}", unread[0].name, unread[0].reason));
    }
    for (UnreadChannel& each : unread) {
      image.metadata.emplace_back(fmt::format("{}{}", kUnreadPrefix, each.name), std::move(each.reason));
    }
    return image;
  }
  throw CurveError("it holds no image; spectroscopy of Nanosurf's .nhf is not read");
}

}  // namespace afm::curves
