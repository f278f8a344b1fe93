// SPDX-License-Identifier: Apache-2.0
#include "formats/nanosurf_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bytes/scaled_unit.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"
#include "formats/segments.h"

namespace afm::curves {

namespace {

constexpr std::string_view kApproach = "Spec forward", kRetract = "Spec backward", kRest = "Spec fwd pause";
constexpr std::size_t kMostInfos = 2000;

// Spring constant, as "D[48]*[N/m]", in N/m; empty for another unit, and unless positive.
std::optional<double> spring_constant_of(const NanosurfFile& file) {
  const NanosurfSection* lever = file.section("DataSet\\Calibration\\Cantilever");
  std::string_view text = lever == nullptr ? std::string_view() : lever->text("Prop0").value_or("");
  if (!text.starts_with("D[") || !text.ends_with("]*[N/m]")) return std::nullopt;
  text.remove_prefix(2);
  text = text.substr(0, text.find(']'));
  if (has_decimal_comma(text)) throw CurveError(decimal_comma_in("its spring constant", text));
  const auto number = number_of(text);
  return number && *number > 0.0 && std::isfinite(*number) ? number : std::nullopt;
}

// Metres of deflection per volt, from the full ranges of the lever's signal in either unit; empty if one is unknown.
// "In5=5,TipSignalDC,Deflection,m,1.393e-06,0"
std::optional<double> sensitivity_of(const NanosurfFile& file) {
  const NanosurfSection* head = file.section("DataSet\\Calibration\\Scanhead");
  if (head == nullptr) return std::nullopt;
  const auto range_of = [&](std::string_view signal, std::string_view unit) -> std::optional<double> {
    std::vector<std::string_view> fields;
    for (const auto& [key, value] : head->values) {
      if (!key.starts_with("In")) continue;
      split(value, ',', fields);
      if (fields.size() < 5 || fields[1] != signal || fields[3] != unit) continue;
      const auto range = number_of(fields[4]);
      return range && *range > 0.0 && std::isfinite(*range) ? range : std::nullopt;
    }
    return std::nullopt;
  };
  const auto metres = range_of("TipSignalDC", "m"), volts = range_of("TipSignalDC1", "V");
  return metres && volts ? std::optional(*metres / *volts) : std::nullopt;
}

std::size_t whole_number(const NanosurfSection& section, std::string_view key) {
  constexpr double kMost = 1e9;
  const double number = section.needed(key);
  if (!(number >= 0.0 && number <= kMost) || number != std::floor(number)) {
    throw CurveError(fmt::format("its \"{}\" is {:g}", key, number));
  }
  return static_cast<std::size_t>(number);
}

std::size_t lines_of(const NanosurfChannel& channel) { return whole_number(*channel.section, "Lines"); }

// Line of a channel, in its unit, without the points that were not recorded.
std::vector<double> line_of(const NanosurfChannel& channel, std::size_t line) {
  const std::size_t points = whole_number(*channel.section, "Points");
  const double recorded =
      channel.section->number(fmt::format("LineDim{}Points", line)).value_or(static_cast<double>(points));
  if (!(recorded >= 0.0 && recorded <= static_cast<double>(points))) {
    throw CurveError(fmt::format("{:g} of its {} points were recorded", recorded, points));
  }
  if (recorded > static_cast<double>(kMostCurvePoints)) throw CurveError("it has more points than a curve may have");
  const NanosurfIntegers integers = nanosurf_integers(*channel.section);
  const double lowest = channel.section->needed("Dim2Min"), range = channel.section->needed("Dim2Range");
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(recorded));
  for (std::size_t i = 0; i < static_cast<std::size_t>(recorded); ++i) {
    values.push_back(lowest + range * nanosurf_share(channel.numbers, line * points + i, integers));
  }
  return values;
}

CurveMetadata metadata_of(const NanosurfFile& file) {
  CurveMetadata metadata;
  metadata.software = "Nanosurf";
  const auto info = [&](std::string_view key) {
    const auto found =
        std::find_if(file.infos.begin(), file.infos.end(), [&](const auto& each) { return each.first == key; });
    return found == file.infos.end() ? std::string() : found->second;
  };
  metadata.software_version = info("Software ver.");
  metadata.instrument = info("Head type");
  return metadata;
}

}  // namespace

NanosurfCurves::NanosurfCurves(std::string_view bytes)
    : file_(nanosurf_file(bytes, kMostInfos, NanosurfEnd::MayLack)),
      approach_(direction_of(kApproach)),
      retract_(direction_of(kRetract)) {
  if (approach_.force == nullptr) {
    throw CurveError("its spectroscopy has no channel \"Deflection\" and \"Z-Axis\": it is no force curve");
  }
  count_ = lines_of(*approach_.force);
  if (count_ == 0) throw CurveError("it has no curves");
  for (const NanosurfChannel* channel : {approach_.height, retract_.force, retract_.height}) {
    if (channel != nullptr && lines_of(*channel) != count_)
      throw CurveError("its channels differ in their number of curves");
  }
  map_ = map_of();
  whole_ = whole_curves();
}

// Number of curves whose lines are complete in all channels.
std::size_t NanosurfCurves::whole_curves() const {
  std::size_t whole = count_;
  for (const NanosurfChannel* channel : {approach_.force, approach_.height, retract_.force, retract_.height}) {
    if (channel == nullptr) continue;
    const std::size_t line = whole_number(*channel->section, "Points") * nanosurf_integers(*channel->section).size;
    if (line > 0) whole = std::min(whole, channel->numbers.size() / line);
  }
  return whole;
}

NanosurfCurves::Direction NanosurfCurves::direction_of(std::string_view group) const {
  const auto named = [&](std::string_view name) -> const NanosurfChannel* {
    const auto found = std::find_if(file_.channels.begin(), file_.channels.end(), [&](const NanosurfChannel& channel) {
      return channel.group == group && channel.section->text("Dim2Name").value_or("") == name;
    });
    return found == file_.channels.end() ? nullptr : &*found;
  };
  Direction direction{named("Deflection"), named("Z-Axis Sensor")};
  if (direction.height == nullptr) direction.height = named("Z-Axis");
  return direction.force != nullptr && direction.height != nullptr ? direction : Direction();
}

// Map of "Map0=x0;x1;y0;y1;columns;rows;rotation;placement", with the places of the outermost curves in metres.
std::optional<NanosurfCurves::Map> NanosurfCurves::map_of() const {
  constexpr std::size_t kFields = 7;
  const NanosurfSection* table = file_.section("DataSet\\SpecInfos\\SpecMapTable");
  const auto text = table == nullptr ? std::nullopt : table->text("Map0");
  if (!text) return std::nullopt;
  std::vector<std::string_view> fields;
  split(*text, ';', fields);
  std::array<double, kFields> values{};
  if (fields.size() < kFields) return std::nullopt;
  for (std::size_t i = 0; i < kFields; ++i) {
    const auto number = number_of(trimmed(fields[i]));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    values[i] = *number;
  }
  const auto [x0, x1, y0, y1, columns, rows, turn] = values;
  const auto is_side = [](double side) {
    return side >= 1.0 && side <= static_cast<double>(kMostMapSide) && side == std::floor(side);
  };
  if (!is_side(columns) || !is_side(rows) || static_cast<double>(count_) > columns * rows) return std::nullopt;
  // a line of one curve is as high as the other side's pitch
  const double across = columns > 1.0 ? std::abs(x1 - x0) / (columns - 1.0) : 0.0;
  const double up = rows > 1.0 ? std::abs(y1 - y0) / (rows - 1.0) : 0.0;
  const double width = columns * (across > 0.0 ? across : up), height = rows * (up > 0.0 ? up : across);
  constexpr double kLargest_m = 1.0;
  if (!(width > 0.0 && width <= kLargest_m && height > 0.0 && height <= kLargest_m)) return std::nullopt;
  return Map{{static_cast<std::size_t>(columns), static_cast<std::size_t>(rows), width, height, 0.5 * (x0 + x1),
              0.5 * (y0 + y1)},
             x1 < x0,
             y1 < y0,
             turn != 0.0};
}

// Newtons per unit of the deflection. The metadata gets the calibration of the file, or else of `reading`, if needed.
double NanosurfCurves::newton_per_unit(const NanosurfSection& force, const CurveReading& reading,
                                       CurveMetadata& metadata) const {
  const ScaledUnit unit = scaled_unit(force.text("Dim2Unit").value_or(""));
  metadata.sensitivity_m_per_v = sensitivity_of(file_);
  if (const auto spring = spring_constant_of(file_)) metadata.spring_constant = physics::Stiffness(*spring);
  if (unit.unit == "N") return unit.factor;
  if (unit.unit != "m" && unit.unit != "V") {
    throw CurveError(fmt::format("its deflection is in \"{}\"; N, m and V are read", unit.unit.substr(0, 40)));
  }
  if (!metadata.spring_constant) metadata.spring_constant = reading.spring_constant;
  if (!metadata.sensitivity_m_per_v) metadata.sensitivity_m_per_v = reading.sensitivity_m_per_v;
  const bool no_spring = !metadata.spring_constant, no_sensitivity = unit.unit == "V" && !metadata.sensitivity_m_per_v;
  if (no_spring || no_sensitivity) {
    throw CurveError(fmt::format("its lever is not calibrated; give {}{}{}", no_spring ? "--spring-constant" : "",
                                 no_spring && no_sensitivity ? " and " : "", no_sensitivity ? "--sensitivity" : ""));
  }
  return unit.factor * metadata.spring_constant->si * (unit.unit == "V" ? *metadata.sensitivity_m_per_v : 1.0);
}

void NanosurfCurves::add_branch(const Direction& from, physics::Branch branch, std::size_t index, double newton,
                                RecordedCurve& curve) const {
  const std::vector<double> force = line_of(*from.force, index), height = line_of(*from.height, index);
  if (force.size() != height.size()) throw CurveError("its channels differ in length");
  const ScaledUnit unit = scaled_unit(from.height->section->text("Dim2Unit").value_or(""));
  if (unit.unit != "m") throw CurveError(fmt::format("its height is in \"{}\"", unit.unit.substr(0, 40)));
  for (std::size_t i = 0; i < force.size(); ++i) {
    curve.points.push_back({physics::Length(unit.factor * height[i]), physics::Force(newton * force[i]), branch});
  }
}

// Pixel of a map's curve; its position unless the map was rotated.
void NanosurfCurves::place(std::size_t index, CurveMetadata& metadata) const {
  if (!map_) return;
  const MapGrid& grid = map_->grid;
  const std::size_t line = index / grid.columns, along = index % grid.columns;
  const bool back = line % 2 == 1;
  const std::size_t column = back != map_->from_right ? grid.columns - 1 - along : along;
  const std::size_t row = map_->from_top ? grid.rows - 1 - line : line;
  metadata.pixel = MapPixel{grid, column, row};
  if (map_->turned) return;
  const auto at = [](std::size_t place, std::size_t count, double side_m, double center_m) {
    return center_m + side_m * ((static_cast<double>(place) + 0.5) / static_cast<double>(count) - 0.5);
  };
  metadata.position = CurvePosition{at(column, grid.columns, grid.width_m, grid.center_x_m),
                                    at(row, grid.rows, grid.height_m, grid.center_y_m)};
}

RecordedCurve NanosurfCurves::curve(std::size_t index, const CurveReading& reading) const {
  const std::string there = count_ == 1 ? "" : fmt::format("it has {} of its {} curves", whole_, count_);
  if (index >= whole_) throw CutShort(there);
  RecordedCurve curve{{}, {}, metadata_of(file_)};
  if (whole_ < count_) curve.metadata.remarks.push_back(cut_short(there));
  const double newton = newton_per_unit(*approach_.force->section, reading, curve.metadata);
  add_branch(approach_, physics::Branch::Approach, index, newton, curve);
  const auto rest = std::find_if(file_.channels.begin(), file_.channels.end(),
                                 [](const NanosurfChannel& channel) { return channel.group == kRest; });
  if (rest != file_.channels.end() && index < lines_of(*rest)) {
    remark_left_out(line_of(*rest, index).size(), kBetweenBranches, "rests", std::nullopt, curve.metadata);
  }
  if (retract_.force != nullptr) {
    if (retract_.force->section->text("Dim2Unit") != approach_.force->section->text("Dim2Unit")) {
      throw CurveError("approach and retract have forces in different units");
    }
    add_branch(retract_, physics::Branch::Retract, index, newton, curve);
  }
  place(index, curve.metadata);
  return curve;
}

}  // namespace afm::curves
