// SPDX-License-Identifier: Apache-2.0
#include "nhf_image.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "curves/curve_error.h"
#include "hdf5_handles.h"
#include "images/image_pages.h"
#include "images/nhf_pages.h"
#include "nhf_reading.h"

namespace afm::curves {

namespace {

std::vector<double> values_of(hid_t channel, std::size_t columns, std::size_t rows, const NhfCalibration& calibration,
                              bool has_fill_value) {
  must_hold_its_data(channel, "of an image");
  const Handle space = must(H5Dget_space(channel), "read a space");
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
  numbers.resize(points, unmeasured);
  return grid_values(columns, rows, true, [&](std::size_t i) {
    const bool measured = !std::isnan(numbers[i]) && numbers[i] != unmeasured;
    return measured ? calibration.value(numbers[i]) : std::numeric_limits<double>::quiet_NaN();
  });
}

void add_channels(hid_t segment, bool has_fill_value, const std::string& direction, physics::ScanImage& image,
                  std::vector<UnreadChannel>& unread) {
  for (const std::string& link : names_in(segment)) {
    const Handle channel = dataset_in(segment, link);
    if (!channel.is_open()) continue;
    std::string name = nhf_channel(channel.get());
    if (name.empty() || image.channels.size() + unread.size() == kMostChannels) continue;
    if (direction != "Forward") name += fmt::format(" ({})", direction == "Backward" ? "retrace" : direction);
    try {
      const NhfCalibration calibration = nhf_calibration(channel.get(), has_fill_value);
      image.channels.push_back({name, calibration.unit.unit,
                                values_of(channel.get(), image.columns, image.rows, calibration, has_fill_value)});
    } catch (const CurveError& fault) {
      unread.push_back({name, fault.what()});
    }
  }
}

}  // namespace

physics::ScanImage nhf_image(std::string_view bytes) {
  const Handle file = open_in_memory(bytes);
  const bool has_fill_value = nhf_version(file.get()) >= 2.0;
  for (const std::string& name : names_in(file.get())) {
    const Handle measurement = group_in(file.get(), name);
    if (!measurement.is_open() || nhf_kind(measurement.get()) != "image_line_based") continue;
    std::vector<std::string> segments;
    NhfGrid grid;
    read_nhf_grid(measurement.get(), grid);
    for (const std::string& part : names_in(measurement.get())) {
      const Handle segment = group_in(measurement.get(), part);
      if (!segment.is_open()) continue;
      segments.push_back(part);
      if (grid.columns == 0.0 || grid.width_m == 0.0) read_nhf_grid(segment.get(), grid);
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
      const std::string direction = nhf_segment(segment.get());
      if (!direction.empty()) add_channels(segment.get(), has_fill_value, direction, image, unread);
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
  throw CurveError("it holds no image");
}

}  // namespace afm::curves
