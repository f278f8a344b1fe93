// SPDX-License-Identifier: Apache-2.0
#include "formats/nanoscope_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bytes/file_bytes.h"
#include "bytes/nanoscope_header.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"
#include "formats/segments.h"

namespace afm::curves {

namespace {

using NanoscopeBlocks = std::vector<NanoscopeBlock>;

constexpr std::string_view kForceChannel = "ciao force image list";
constexpr std::array<std::size_t, 2> kIntegerSizes{2, 4};

// True for integers of two bytes, which may be stored in four.
bool has_two_bytes(const NanoscopeBlock& channel) {
  const std::string_view* text = channel.find("bytes/pixel");
  return text != nullptr && trimmed(*text) == "2";
}

std::vector<const NanoscopeBlock*> force_channels(const NanoscopeBlocks& blocks) {
  std::vector<const NanoscopeBlock*> channels;
  for (const NanoscopeBlock& block : blocks) {
    if (lower_key(block.name) == kForceChannel) channels.push_back(&block);
  }
  return channels;
}

// The first channel whose name begins with one of these; null if there is none.
const NanoscopeBlock* channel_named(const std::vector<const NanoscopeBlock*>& channels,
                                    std::initializer_list<std::string_view> names) {
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const NanoscopeBlock* channel) {
    const std::string own = lower_key(nanoscope_channel(*channel));
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return own.starts_with(name); });
  });
  return found != channels.end() ? *found : nullptr;
}

// Newtons per volt by the file's calibration, or else by that of `reading`; both are written into the metadata.
double newton_per_volt(const NanoscopeBlock& deflection, const NanoscopeBlocks& blocks, const CurveReading& reading,
                       CurveMetadata& metadata) {
  const auto scale = hard_scale(deflection.find("@4:z scale"));
  const std::string_view sensitivity = scale && !scale->soft_name.empty() ? scale->soft_name : "Sens. DeflSens";
  metadata.sensitivity_m_per_v = nanoscope_metres_per_volt(blocks, sensitivity);
  if (deflection.find("spring constant") != nullptr) {
    if (const double k = nanoscope_spring_constant(deflection); k != 0.0)
      metadata.spring_constant = physics::Stiffness(k);
  }
  if (!metadata.sensitivity_m_per_v) metadata.sensitivity_m_per_v = reading.sensitivity_m_per_v;
  if (!metadata.spring_constant) metadata.spring_constant = reading.spring_constant;
  const bool no_sensitivity = !metadata.sensitivity_m_per_v, no_spring = !metadata.spring_constant;
  if (no_sensitivity || no_spring) {
    const auto bare = soft_scale(blocks, sensitivity, "V");  // sensitivity whose unit some files omit
    const bool has_bare = no_sensitivity && bare && bare->unit.empty() && bare->factor != 1.0;
    throw CurveError(
        fmt::format("its lever is not calibrated; give {}{}{}{}", no_spring ? "--spring-constant" : "",
                    no_spring && no_sensitivity ? " and " : "", no_sensitivity ? "--sensitivity" : "",
                    has_bare ? fmt::format(" (its \"{}\" of {:g} has no unit)", sensitivity, bare->factor) : ""));
  }
  return *metadata.sensitivity_m_per_v * metadata.spring_constant->si;
}

// Metadata of a curve; `held` of its points are those of a hold.
CurveMetadata nanoscope_metadata(const NanoscopeBlocks& blocks, std::size_t held) {
  CurveMetadata metadata;
  metadata.software = "NanoScope";
  if (const auto version = nanoscope_version(blocks); version != 0)
    metadata.software_version = fmt::format("0x{:08x}", version);
  for (const NanoscopeBlock& block : blocks) {
    const std::string name = lower_key(block.name);
    if (const auto* date = block.find("date"); date != nullptr && name == "force file list") {
      const NanoscopeTime time = nanoscope_time(*date);
      metadata.date = time.day;
      metadata.time = time.clock;
    }
    if (const auto* microscope = block.find("microscope"); microscope != nullptr && name == "equipment list") {
      metadata.instrument = *microscope;
    }
    if (name == kNanoscopeForceList && held > 0) {
      const bool timed = block.find("hold time") != nullptr;
      const double hold_s = timed ? nanoscope_number(block, "hold time") : 0.0;
      remark_left_out(held, kBetweenBranches, "rests", hold_s > 0.0 ? std::optional(hold_s) : std::nullopt, metadata);
    } else if (name == kNanoscopeForceList && block.find("reverse delay") != nullptr) {
      if (const double delay_s = nanoscope_number(block, "reverse delay"); delay_s > 0.0) {
        remark_left_out(0, kBetweenBranches, "rests", delay_s, metadata);
      }
    }
  }
  return metadata;
}

}  // namespace

// Integers or heights of both branches, in the order of time; NaN: not recorded.
struct NanoscopeCurves::Signal {
  std::vector<double> extend, retract;
  std::size_t integer_size = 0;

  std::vector<double> period() const {
    std::vector<double> both = extend;
    both.insert(both.end(), retract.begin(), retract.end());
    return both;
  }

  // Begins a period of both branches at one of its points.
  void begin_at(std::size_t first, double factor = 1.0) {
    std::vector<double> both = period();
    std::rotate(both.begin(), both.begin() + static_cast<std::ptrdiff_t>(first), both.end());
    for (double& value : both) value *= factor;
    const auto turn = both.begin() + static_cast<std::ptrdiff_t>(extend.size());
    extend.assign(both.begin(), turn);
    retract.assign(turn, both.end());
  }
};

std::size_t NanoscopeCurves::Lengths::longer() const { return std::max(extend, retract); }

// Lengths in "512 512", or one number for both branches.
NanoscopeCurves::Lengths NanoscopeCurves::lengths_of(const NanoscopeBlock& channel) {
  const std::string_view* text = channel.find("samps/line");
  if (text == nullptr) throw CurveError("a channel of it has no \"Samps/line\"");
  std::string_view rest = *text;
  const auto length_in = [&](std::optional<double> number) {
    if (!number || !(*number >= 2.0 && *number <= static_cast<double>(kMostCurvePoints)) ||
        *number != std::floor(*number)) {
      throw CurveError(
          fmt::format("its branches have \"{}\" points; 2 to {} are read", text->substr(0, 40), kMostCurvePoints));
    }
    return static_cast<std::size_t>(*number);
  };
  const std::size_t retract = length_in(take_number(rest));
  return {trimmed(rest).empty() ? retract : length_in(take_number(rest)), retract};
}

// Points of the hold in each curve of a channel with a hold.
std::size_t NanoscopeCurves::hold_of(const std::vector<NanoscopeBlock>& blocks) {
  for (const NanoscopeBlock& block : blocks) {
    if (lower_key(block.name) != kNanoscopeForceList || block.find("hold samples") == nullptr) continue;
    const double points = nanoscope_number(block, "hold samples");
    if (!(points >= 0.0 && points <= static_cast<double>(kMostCurvePoints)) || points != std::floor(points))
      throw CurveError(fmt::format("its hold has {:g} points; 0 to {} are read", points, kMostCurvePoints));
    return static_cast<std::size_t>(points);
  }
  return 0;
}

NanoscopeCurves::NanoscopeCurves(std::string_view bytes) : bytes_(bytes), blocks_(nanoscope_blocks(bytes)) {
  try {
    read_header();
  } catch (const CurveError&) {
    if (!nanoscope_header_ends(bytes)) throw CutShort(kNoHeaderEnd);
    throw;
  }
}

void NanoscopeCurves::read_header() {
  const auto channels = force_channels(blocks_);
  deflection_ = channel_named(channels, {"deflection"});
  if (deflection_ == nullptr) {
    std::string names;
    for (const NanoscopeBlock* channel : channels) {
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", nanoscope_channel(*channel).substr(0, 40));
      if (names.size() > 200) break;
    }
    throw CurveError(fmt::format("it is a Nanoscope force curve without a deflection; its channels are {}",
                                 names.empty() ? "none" : names));
  }
  sensor_ = channel_named(channels, {"height sensor", "zsensor", "z sensor"});
  lengths_ = lengths_of(*deflection_);
  hold_ = hold_of(blocks_);
  volume_ = nanoscope_volume(bytes_, blocks_);
  const double length = nanoscope_number(*deflection_, "data length");
  // a ramp may have the image beside it in which its place was chosen
  if (layout_of(*deflection_)) {
    if (volume_ && volume_->image_is_cut) throw CutShort("its image is not whole");
    volume_.reset();
  }
  if (volume_) find_curves(channels, length);
  count_whole();
}

// Finds the curves of a volume whose deflection has `length` bytes.
void NanoscopeCurves::find_curves(const std::vector<const NanoscopeBlock*>& channels, double length) {
  if (is_peakforce_capture(blocks_)) {
    // the second of its lengths may be wrong
    lengths_.extend = lengths_.retract;
    if (sensor_ == nullptr) sensor_ = channel_named(channels, {"height"});
    is_sensed_period_ = sensor_ != nullptr;
    if (!is_sensed_period_) swing_ = nanoscope_swing(blocks_, 2 * lengths_.longer());
  }
  if (volume_->columns > 0 && volume_->rows > 0) {
    count_ = volume_->columns * volume_->rows;
    return;
  }
  // without a grid, as many as its data hold
  const auto curve =
      static_cast<double>((2 * lengths_.longer() + hold_) * nanoscope_integers(*deflection_, blocks_).size);
  const double count = length / curve;
  if (!(count >= 1.0 && count <= static_cast<double>(kMostMapSide * kMostMapSide)) || count != std::floor(count)) {
    throw CurveError(fmt::format("its data are {:g} curves of two branches of {} points", count, lengths_.longer()));
  }
  count_ = static_cast<std::size_t>(count);
}

// Counts the curves with complete data in every channel that is read.
void NanoscopeCurves::count_whole() {
  whole_ = count_;
  for (const NanoscopeBlock* channel : {deflection_, sensor_}) {
    const auto layout = channel != nullptr ? layout_of(*channel) : std::nullopt;
    if (!layout) continue;
    const double offset = nanoscope_number(*channel, "data offset"), size = static_cast<double>(bytes_.size());
    const double behind = offset < size ? size - static_cast<double>(nanoscope_data_offset(*channel, bytes_)) : 0.0;
    const double there = std::floor(behind / static_cast<double>(layout->points * layout->size));
    if (there < static_cast<double>(whole_)) whole_ = static_cast<std::size_t>(there);
  }
}

std::string NanoscopeCurves::whole_of_all() const {
  return count_ == 1 ? std::string() : fmt::format("it has {} of its {} curves", whole_, count_);
}

// Layout of a channel's data; empty if it does not contain such curves. Either all of its curves have a hold, or none.
std::optional<NanoscopeCurves::Layout> NanoscopeCurves::layout_of(const NanoscopeBlock& channel) const {
  const double length = nanoscope_number(channel, "data length");
  std::vector<Layout> found;
  for (const std::size_t hold : {hold_, std::size_t{0}}) {
    for (const std::size_t size : kIntegerSizes) {
      const Layout layout{.size = size, .points = 2 * lengths_.longer() + hold};
      if (length == static_cast<double>(count_ * layout.points * size)) found.push_back(layout);
    }
    if (hold_ == 0) break;
  }
  if (found.size() > 1) {  // ambiguous: twice as many points, or twice as many bytes each
    const std::size_t size = nanoscope_integers(channel, blocks_).size;
    std::erase_if(found, [&](const Layout& layout) { return layout.size != size; });
  }
  return found.empty() ? std::nullopt : std::optional(found.front());
}

NanoscopeCurves::Layout NanoscopeCurves::known_layout(const NanoscopeBlock& channel) const {
  if (const auto layout = layout_of(channel)) return *layout;
  if (!nanoscope_header_ends(bytes_)) throw CutShort(kNoHeaderEnd);
  const std::string curves =
      volume_ ? fmt::format("{} x {} curves of ", volume_->columns, volume_->rows) : std::string();
  const std::string hold = hold_ > 0 ? fmt::format(", with {} points of a hold or without", hold_) : std::string();
  throw CurveError(fmt::format(
      "its channel {} has {:g} bytes, which are not {}two branches of {} points{}; volumes that were stopped are not "
      "read: save their curves one by one in Nanoscope Analysis",
      nanoscope_channel(channel), nanoscope_number(channel, "data length"), curves, lengths_.longer(), hold));
}

NanoscopeCurves::Signal NanoscopeCurves::signal(const NanoscopeBlock& channel, std::size_t index) const {
  const Layout layout = known_layout(channel);
  const std::size_t size = layout.size, points = layout.points;
  const std::size_t half = lengths_.longer();
  if (index >= whole_) throw CutShort(whole_of_all());
  const std::size_t offset = nanoscope_data_offset(channel, bytes_);
  const std::string_view data = part(bytes_, offset + index * points * size, 2 * half * size);
  const double lowest = -0.5 * std::pow(256.0, static_cast<double>(size));
  const double lowest_of_two = has_two_bytes(channel) ? std::numeric_limits<std::int16_t>::min() : lowest;
  const auto branch = [&](std::size_t first, std::size_t count) {
    std::vector<double> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double integer = nanoscope_integer(data, first + i, size);
      if (volume_ && std::abs(integer) > -lowest_of_two) {
        throw CurveError(fmt::format(
            "its channel {} has numbers of more than the two bytes that its header states: was its header altered?",
            nanoscope_channel(channel)));
      }
      const bool recorded = integer != lowest && integer != lowest_of_two;
      values.push_back(recorded ? integer : std::numeric_limits<double>::quiet_NaN());
    }
    return values;
  };
  Signal integers{branch(0, lengths_.extend), branch(half, lengths_.retract), size};
  std::reverse(integers.extend.begin(), integers.extend.end());
  if (swing_) integers.begin_at(swing_->first());
  return integers;
}

// Heights of the base, falling while the tip approaches.
NanoscopeCurves::Signal NanoscopeCurves::heights(std::size_t index) const {
  if (swing_) {
    std::vector<double> period = swing_->heights_m();
    for (double& height_m : period) height_m += volume_->surface_m(index);
    const auto turn = period.begin() + static_cast<std::ptrdiff_t>(lengths_.extend);
    return {{period.begin(), turn}, {turn, period.end()}, 0};
  }
  if (sensor_ == nullptr) {
    const double step_m = nanoscope_ramp_m(*deflection_, blocks_) / static_cast<double>(lengths_.longer());
    const double lowest_m = volume_ ? volume_->surface_m(index) : 0.0;
    Signal ramp;
    for (std::size_t i = lengths_.extend; i-- > 0;) ramp.extend.push_back(lowest_m + static_cast<double>(i) * step_m);
    for (std::size_t i = 0; i < lengths_.retract; ++i) {
      ramp.retract.push_back(lowest_m + static_cast<double>(i) * step_m);
    }
    return ramp;
  }
  const auto scale = hard_scale(sensor_->find("@4:z scale"));
  const auto per_volt = scale ? nanoscope_metres_per_volt(blocks_, scale->soft_name) : std::nullopt;
  if (!per_volt)
    throw CurveError(fmt::format("it does not say how to convert its {} to metres", nanoscope_channel(*sensor_)));
  Signal heights = signal(*sensor_, index);
  double factor = nanoscope_value_per_integer(*sensor_, heights.integer_size) * *per_volt;
  if (is_sensed_period_) {
    heights.begin_at(0, factor);
    return heights;
  }
  // the sensor may count towards the sample
  const auto recorded = [](double value) { return !std::isnan(value); };
  const auto first = std::find_if(heights.extend.begin(), heights.extend.end(), recorded);
  const auto last = std::find_if(heights.extend.rbegin(), heights.extend.rend(), recorded);
  if (first != heights.extend.end() && factor * (*last - *first) > 0.0) factor = -factor;
  for (auto* branch : {&heights.extend, &heights.retract}) {
    for (double& value : *branch) value *= factor;
  }
  return heights;
}

// Pixel of a force volume's curve, and its position unless the scan was rotated.
void NanoscopeCurves::place(std::size_t index, RecordedCurve& curve) const {
  if (!volume_) return;
  for (const std::string& remark : volume_->remarks) curve.metadata.remarks.push_back(remark);
  if (!volume_->grid) return;
  const MapGrid& grid = *volume_->grid;
  const std::size_t column = index % grid.columns, row = index / grid.columns;
  curve.metadata.pixel = MapPixel{grid, column, row};
  if (volume_->turn_deg != 0.0) return;
  const auto at = [](std::size_t place, std::size_t count, double side_m, double center_m) {
    return center_m + side_m * ((static_cast<double>(place) + 0.5) / static_cast<double>(count) - 0.5);
  };
  curve.metadata.position = CurvePosition{at(column, grid.columns, grid.width_m, grid.center_x_m),
                                          at(row, grid.rows, grid.height_m, grid.center_y_m)};
}

RecordedCurve NanoscopeCurves::curve(std::size_t index, const CurveReading& reading) const {
  const std::size_t held = known_layout(*deflection_).points - 2 * lengths_.longer();
  RecordedCurve curve{{}, {}, nanoscope_metadata(blocks_, held)};
  const double per_volt = newton_per_volt(*deflection_, blocks_, reading, curve.metadata);
  Signal volts = signal(*deflection_, index), z = heights(index);
  if (is_sensed_period_) {
    const SensedPeriod sensed = sensed_period(z.period(), volts.period());
    volts.begin_at(sensed.first);
    z.begin_at(sensed.first, sensed.sign);
    curve.metadata.remarks.emplace_back(kSensedPeriod);
  }
  const double factor = nanoscope_value_per_integer(*deflection_, volts.integer_size) * per_volt;
  std::size_t unrecorded = 0;
  const auto add_branch = [&](const std::vector<double>& z_m, const std::vector<double>& values,
                              physics::Branch branch) {
    for (std::size_t i = 0; i < z_m.size(); ++i) {
      if (std::isnan(z_m[i]) || std::isnan(values[i])) {
        ++unrecorded;
        continue;
      }
      curve.points.push_back({physics::Length(z_m[i]), physics::Force(factor * values[i]), branch});
    }
  };
  add_branch(z.extend, volts.extend, physics::Branch::Approach);
  add_branch(z.retract, volts.retract, physics::Branch::Retract);
  if (unrecorded > 0) {
    curve.metadata.remarks.push_back(fmt::format("{} of its {} points were not recorded: they are left out", unrecorded,
                                                 unrecorded + curve.points.size()));
  }
  if (whole_ < count_) curve.metadata.remarks.push_back(cut_short(whole_of_all()));
  if (swing_) {
    curve.metadata.remarks.push_back(fmt::format(
        "it is a period of PeakForce tapping: its heights are those of a swing of {:g} nm to either side, whose force "
        "includes drag and inertia",
        swing_->amplitude_m * 1e9));
  }
  place(index, curve);
  return curve;
}

}  // namespace afm::curves
