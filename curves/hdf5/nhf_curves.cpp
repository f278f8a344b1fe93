// SPDX-License-Identifier: Apache-2.0
#include "nhf_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "curves/curve_error.h"
#include "formats/segments.h"

namespace afm::curves {

namespace {

constexpr std::string_view kApproach = "Advance", kRetract = "Retract";
constexpr std::size_t kMostCurves = 4'000'000;

// Reads all numbers of a short data set.
std::vector<double> numbers_of(hid_t set) {
  must_hold_its_data(set, "of the numbers of points");
  const Handle space = must(H5Dget_space(set), "read a space");
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count < 1 || count > static_cast<hssize_t>(kMostCurves)) throw CurveError(fmt::format("it has {} curves", count));
  std::vector<double> numbers(static_cast<std::size_t>(count));
  if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0) {
    throw CurveError("it is damaged");
  }
  return numbers;
}

std::size_t whole_number(double number) {
  constexpr double kMost = 1e12;
  if (!(number >= 0.0 && number <= kMost) || number != std::floor(number)) {
    throw CurveError(fmt::format("a curve of it has {:g} points", number));
  }
  return static_cast<std::size_t>(number);
}

// Pixel of a curve in a grid that is recorded line by line from the bottom, there and back.
std::optional<MapPixel> pixel_of(std::size_t index, std::size_t curves, const NhfGrid& grid) {
  const auto is_side = [](double side) {
    return side >= 1.0 && side <= static_cast<double>(kMostMapSide) && side == std::floor(side);
  };
  if (!is_side(grid.columns) || !is_side(grid.rows) || !(grid.width_m > 0.0 && grid.height_m > 0.0))
    return std::nullopt;
  const MapGrid map{static_cast<std::size_t>(grid.columns),
                    static_cast<std::size_t>(grid.rows),
                    grid.width_m,
                    grid.height_m,
                    0.0,
                    0.0};
  if (curves > map.columns * map.rows) return std::nullopt;
  const std::size_t row = index / map.columns, along = index % map.columns;
  return MapPixel{map, row % 2 == 1 ? map.columns - 1 - along : along, row};
}

}  // namespace

NhfCurves::NhfCurves(std::string_view bytes) : file_(open_in_memory(bytes)), version_(nhf_version(file_.get())) {
  for (const std::string& name : names_in(file_.get())) {
    const Handle measurement = group_in(file_.get(), name);
    if (!measurement.is_open() || !nhf_kind(measurement.get()).starts_with("spectroscopy")) continue;
    spring_n_per_m_ = number_attribute(measurement.get(), "spm_probe_calibration_spring_constant");
    sensitivity_m_per_v_ = number_attribute(measurement.get(), "spm_probe_calibration_deflection_sensitivity");
    read_nhf_grid(measurement.get(), grid_);
    for (const std::string& part : names_in(measurement.get())) {
      const Handle group = group_in(measurement.get(), part);
      if (!group.is_open()) continue;
      const std::string title = nhf_segment(group.get());
      if (grid_.columns == 0.0 || grid_.width_m == 0.0) read_nhf_grid(group.get(), grid_);
      const bool approached = approach_.force.data.is_open(), retracted = retract_.force.data.is_open();
      if (!approached && title.starts_with(kApproach)) {
        approach_ = segment_of(group.get());
      } else if (approached && !retracted && title.starts_with(kRetract)) {
        retract_ = segment_of(group.get());
      } else {
        const char* when = retracted ? kAfterRetract : approached ? kBetweenBranches : kBeforeApproach;
        rests_.push_back({title, when, extents_in(group.get())});
      }
    }
    if (!approach_.force.data.is_open()) break;
    if (retract_.force.data.is_open() && retract_.curves.size() != approach_.curves.size()) {
      throw CurveError("approach and retract differ in their number of curves");
    }
    return;
  }
  throw CurveError("it is a Nanosurf file without a force curve: no spectroscopy with a part \"Advance\"");
}

// Points of each curve. Version 2 stores their numbers, version 1 also the first points. Empty if the file has none.
std::vector<NhfCurves::Extent> NhfCurves::extents_in(hid_t group) const {
  std::vector<double> counts, firsts;
  for (const std::string& link : names_in(group)) {
    const Handle set = dataset_in(group, link);
    if (!set.is_open()) continue;
    const std::string name = nhf_channel(set.get());
    const bool has_counts =
        version_ >= 2.0 ? H5Aexists(set.get(), "dataset_block_size_id") > 0 : name == "number_of_datapoints_acquired";
    if (has_counts && counts.empty()) counts = numbers_of(set.get());
    if (version_ < 2.0 && name == "channel_data_offsets") firsts = numbers_of(set.get());
  }
  if (version_ < 2.0 && firsts.size() != counts.size()) return {};
  std::vector<Extent> extents;
  std::size_t next = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::size_t count = whole_number(counts[i]);
    extents.push_back({version_ < 2.0 ? whole_number(firsts[i]) : next, count});
    next += count;
  }
  return extents;
}

NhfCurves::Segment NhfCurves::segment_of(hid_t group) const {
  Segment segment;
  for (const std::string& link : names_in(group)) {
    Handle set = dataset_in(group, link);
    if (!set.is_open()) continue;
    const std::string name = nhf_channel(set.get());
    if (name != "Position Z" && name != "Deflection") continue;
    must_hold_its_data(set.get(), name.c_str());
    Channel& channel = name == "Deflection" ? segment.force : segment.height;
    channel.calibration = nhf_calibration(set.get(), version_ >= 2.0);
    channel.data = std::move(set);
  }
  if (!segment.force.data.is_open() || !segment.height.data.is_open()) {
    throw CurveError("a part of its curves has no channel \"Deflection\" and \"Position Z\"");
  }
  if (segment.height.calibration.unit.unit != "m") {
    throw CurveError(fmt::format("its height is in \"{}\"", segment.height.calibration.unit.unit.substr(0, 40)));
  }
  segment.curves = extents_in(group);
  if (segment.curves.empty()) throw CurveError("it does not say how many points its curves have");
  return segment;
}

std::vector<double> NhfCurves::values_of(const Channel& channel, const Extent& extent) const {
  const hsize_t first = extent.first, count = extent.count;
  if (count > kMostCurvePoints) throw CurveError("it has more points than a curve may have");
  const Handle space = must(H5Dget_space(channel.data.get()), "read a space");
  const hssize_t all = H5Sget_simple_extent_npoints(space.get());
  if (H5Sget_simple_extent_ndims(space.get()) != 1 || all < 0 || first + count > static_cast<hsize_t>(all)) {
    throw CurveError(cut_short(fmt::format("{} points of its curves are there", all)));
  }
  std::vector<double> values(static_cast<std::size_t>(count));
  if (count == 0) return values;
  const Handle memory = must(H5Screate_simple(1, &count, nullptr), "make a space");
  must_do(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &first, nullptr, &count, nullptr), "choose points");
  if (H5Dread(channel.data.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, values.data()) < 0) {
    throw CurveError("it is damaged");
  }
  for (double& value : values) value = channel.calibration.value(value);
  return values;
}

// Newtons per unit of the deflection. The metadata gets the calibration of `reading` if needed and missing in the file.
double NhfCurves::newton_per_unit(const std::string& unit, const CurveReading& reading, CurveMetadata& metadata) const {
  if (unit == "N") return 1.0;
  if (unit != "m" && unit != "V") {
    throw CurveError(fmt::format("its deflection is in \"{}\"; N, m and V are read", unit.substr(0, 40)));
  }
  if (!metadata.spring_constant) metadata.spring_constant = reading.spring_constant;
  if (!metadata.sensitivity_m_per_v) metadata.sensitivity_m_per_v = reading.sensitivity_m_per_v;
  const bool no_spring = !metadata.spring_constant, no_sensitivity = unit == "V" && !metadata.sensitivity_m_per_v;
  if (no_spring || no_sensitivity) {
    throw CurveError(fmt::format("its lever is not calibrated; give {}{}{}", no_spring ? "--spring-constant" : "",
                                 no_spring && no_sensitivity ? " and " : "", no_sensitivity ? "--sensitivity" : ""));
  }
  return metadata.spring_constant->si * (unit == "V" ? *metadata.sensitivity_m_per_v : 1.0);
}

void NhfCurves::add_branch(const Segment& segment, physics::Branch branch, std::size_t index,
                           const CurveReading& reading, RecordedCurve& curve) const {
  const std::vector<double> height = values_of(segment.height, segment.curves[index]),
                            force = values_of(segment.force, segment.curves[index]);
  const double newton = newton_per_unit(segment.force.calibration.unit.unit, reading, curve.metadata);
  for (std::size_t i = 0; i < force.size(); ++i) {
    curve.points.push_back({physics::Length(height[i]), physics::Force(newton * force[i]), branch});
  }
}

RecordedCurve NhfCurves::curve(std::size_t index, const CurveReading& reading) const {
  if (index >= size()) {
    throw CurveError(fmt::format("it has no curve {}; it has {}, counted from 0", index, size()));
  }
  RecordedCurve curve;
  curve.metadata.software = "Nanosurf Studio";
  if (spring_n_per_m_) curve.metadata.spring_constant = physics::Stiffness(*spring_n_per_m_);
  curve.metadata.sensitivity_m_per_v = sensitivity_m_per_v_;
  curve.metadata.pixel = pixel_of(index, size(), grid_);
  add_branch(approach_, physics::Branch::Approach, index, reading, curve);
  if (retract_.force.data.is_open()) add_branch(retract_, physics::Branch::Retract, index, reading, curve);
  for (const Rest& rest : rests_) {
    if (index >= rest.curves.size() || rest.curves[index].count == 0) continue;
    remark_left_out(rest.curves[index].count, rest.when, fmt::format("is in a part \"{}\"", rest.name.substr(0, 40)),
                    std::nullopt, curve.metadata);
  }
  return curve;
}

}  // namespace afm::curves
