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
#include "bytes/scaled_unit.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"
#include "formats/nanoscope_header.h"
#include "formats/segments.h"

namespace afm::curves {

namespace {

using NanoscopeBlocks = std::vector<NanoscopeBlock>;

constexpr std::string_view kForceChannel = "ciao force image list", kForceList = "ciao force list";
constexpr std::array<std::size_t, 2> kIntegerSizes{2, 4};

// The name in S [DeflectionError] "Deflection Error".
std::string_view channel_name(const NanoscopeBlock& channel) {
  for (const char* key : {"@4:image data", "@2:image data"}) {
    const std::string_view* data = channel.find(key);
    if (data == nullptr) continue;
    const std::size_t open = data->find('"'), close = data->rfind('"');
    if (open != std::string_view::npos && close > open) return data->substr(open + 1, close - open - 1);
  }
  return {};
}

std::vector<const NanoscopeBlock*> force_channels(const NanoscopeBlocks& blocks) {
  std::vector<const NanoscopeBlock*> channels;
  for (const NanoscopeBlock& block : blocks) {
    if (lower_key(block.name) == kForceChannel) channels.push_back(&block);
    if (lower_key(block.name) == "ciao image list") {
      throw CurveError("it is a Nanoscope force volume of many curves; export one of them as a single curve");
    }
  }
  return channels;
}

// The first channel whose name begins with one of these; null if there is none.
const NanoscopeBlock* channel_named(const std::vector<const NanoscopeBlock*>& channels,
                                    std::initializer_list<std::string_view> names) {
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const NanoscopeBlock* channel) {
    const std::string own = lower_key(channel_name(*channel));
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return own.starts_with(name); });
  });
  return found != channels.end() ? *found : nullptr;
}

struct BranchLengths {
  std::size_t extend = 0, retract = 0;
  std::size_t longer() const { return std::max(extend, retract); }
};

// "512 512", or one number for both.
BranchLengths branch_lengths(const NanoscopeBlock& channel) {
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

// The integers of both branches in the order of time.
struct ChannelIntegers {
  std::vector<double> extend, retract;  // NaN: not recorded
  std::size_t integer_size = 0;
};

template <class Integer>
std::vector<double> branch_integers(std::string_view data, std::size_t count) {
  std::vector<double> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto integer = number_at<Integer>(data, i * sizeof(Integer));
    const bool recorded = integer != std::numeric_limits<Integer>::min();
    values.push_back(recorded ? static_cast<double>(integer) : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

ChannelIntegers channel_integers(std::string_view bytes, const NanoscopeBlock& channel, const BranchLengths& lengths) {
  const double offset = nanoscope_number(channel, "data offset"), length = nanoscope_number(channel, "data length");
  const std::size_t points = 2 * lengths.longer();
  const auto size = std::find_if(kIntegerSizes.begin(), kIntegerSizes.end(),
                                 [&](std::size_t each) { return length == static_cast<double>(points * each); });
  if (size == kIntegerSizes.end()) {
    throw CurveError(
        fmt::format("its channel {} has {:g} bytes, which are not two branches of {} points: single ramps without a "
                    "hold are read, no force volumes",
                    channel_name(channel), length, lengths.longer()));
  }
  if (!(offset >= 0.0 && offset <= static_cast<double>(bytes.size()))) throw CutShort("it is cut short");
  const std::string_view data = part(bytes, static_cast<std::size_t>(offset), points * *size);
  const std::string_view far_half = data.substr(data.size() / 2);
  const auto branch = [&](std::string_view half, std::size_t count) {
    return *size == 2 ? branch_integers<std::int16_t>(half, count) : branch_integers<std::int32_t>(half, count);
  };
  ChannelIntegers integers{branch(data, lengths.extend), branch(far_half, lengths.retract), *size};
  std::reverse(integers.extend.begin(), integers.extend.end());
  return integers;
}

// The value of one integer, before any sensitivity. The header prints it rounded, and its full range exactly, which in
// older files is that of the screen.
double value_per_integer(const NanoscopeBlock& channel, std::size_t integer_size) {
  const auto scale = hard_scale(channel.find("@4:z scale"));
  if (!scale || (!scale->per_lsb && !scale->value)) {
    throw CurveError(fmt::format("its channel {} has no \"@4:Z scale\"", channel_name(channel)));
  }
  constexpr double kRounding = 0.01;
  const double unit = scaled_unit(scale->unit).factor;
  const double of_range = scale->value.value_or(0.0) / std::pow(256.0, static_cast<double>(integer_size));
  if (!scale->per_lsb) return unit * of_range;
  return unit * (std::abs(of_range / *scale->per_lsb - 1.0) < kRounding ? of_range : *scale->per_lsb);
}

// Metres of a volt; empty where the file does not tell.
std::optional<double> length_sensitivity(const NanoscopeBlocks& blocks, std::string_view name) {
  const auto soft = soft_scale(blocks, name, "V");
  return soft && soft->unit == "m" && soft->factor != 0.0 ? std::optional(soft->factor) : std::nullopt;
}

// The length of the ramp: "@4:Ramp size" of the channel, or an older key of the force list.
double ramp_length_m(const NanoscopeBlock& channel, const NanoscopeBlocks& blocks) {
  const auto list = std::find_if(blocks.begin(), blocks.end(),
                                 [](const NanoscopeBlock& block) { return lower_key(block.name) == kForceList; });
  for (const NanoscopeBlock* block : {&channel, list != blocks.end() ? &*list : &channel}) {
    for (const char* key : {"@4:ramp size", "@4:ramp size zsweep", "@ramp size", "@z scan size"}) {
      const auto scale = hard_scale(block->find(key));
      if (!scale || !scale->value) continue;
      const auto per_volt = length_sensitivity(blocks, scale->soft_name.empty() ? "Sens. Zsens" : scale->soft_name);
      if (!per_volt) throw CurveError(fmt::format("it does not say how long its ramp of {:g} V is", *scale->value));
      return std::abs(*scale->value * scaled_unit(scale->unit).factor * *per_volt);
    }
  }
  throw CurveError("it has neither a channel of the height nor a \"Ramp size\"");
}

// Heights of the base in the order of time, falling while the tip approaches.
std::pair<std::vector<double>, std::vector<double>> ramp_heights(std::string_view bytes, const NanoscopeBlock* sensor,
                                                                 const NanoscopeBlock& deflection,
                                                                 const NanoscopeBlocks& blocks,
                                                                 const BranchLengths& lengths) {
  std::vector<double> extend, retract;
  if (sensor == nullptr) {
    const double step_m = ramp_length_m(deflection, blocks) / static_cast<double>(lengths.longer());
    for (std::size_t i = lengths.extend; i-- > 0;) extend.push_back(static_cast<double>(i) * step_m);
    for (std::size_t i = 0; i < lengths.retract; ++i) retract.push_back(static_cast<double>(i) * step_m);
    return {extend, retract};
  }
  const auto scale = hard_scale(sensor->find("@4:z scale"));
  const auto per_volt = scale ? length_sensitivity(blocks, scale->soft_name) : std::nullopt;
  if (!per_volt)
    throw CurveError(fmt::format("it does not say how to convert its {} to metres", channel_name(*sensor)));
  ChannelIntegers integers = channel_integers(bytes, *sensor, lengths);
  double factor = value_per_integer(*sensor, integers.integer_size) * *per_volt;
  // the sensor may count towards the sample
  const auto recorded = [](double value) { return !std::isnan(value); };
  const auto first = std::find_if(integers.extend.begin(), integers.extend.end(), recorded);
  const auto last = std::find_if(integers.extend.rbegin(), integers.extend.rend(), recorded);
  if (first != integers.extend.end() && factor * (*last - *first) > 0.0) factor = -factor;
  for (auto* branch : {&integers.extend, &integers.retract}) {
    for (double& value : *branch) value *= factor;
  }
  return {std::move(integers.extend), std::move(integers.retract)};
}

// The file's calibration, otherwise that of `reading`, which both are written into the metadata.
double newton_per_volt(const NanoscopeBlock& deflection, const NanoscopeBlocks& blocks, const CurveReading& reading,
                       CurveMetadata& metadata) {
  const auto scale = hard_scale(deflection.find("@4:z scale"));
  metadata.sensitivity_m_per_v =
      length_sensitivity(blocks, scale && !scale->soft_name.empty() ? scale->soft_name : "Sens. DeflSens");
  if (deflection.find("spring constant") != nullptr) {
    const double k = nanoscope_number(deflection, "spring constant");
    if (k != 0.0) metadata.spring_constant = physics::Stiffness(k);
  }
  if (!metadata.sensitivity_m_per_v) metadata.sensitivity_m_per_v = reading.sensitivity_m_per_v;
  if (!metadata.spring_constant) metadata.spring_constant = reading.spring_constant;
  const bool no_sensitivity = !metadata.sensitivity_m_per_v, no_spring = !metadata.spring_constant;
  if (no_sensitivity || no_spring) {
    throw CurveError(fmt::format("its lever is not calibrated; give {}{}{}", no_spring ? "--spring-constant" : "",
                                 no_spring && no_sensitivity ? " and " : "", no_sensitivity ? "--sensitivity" : ""));
  }
  return *metadata.sensitivity_m_per_v * metadata.spring_constant->si;
}

// "04:42:34 PM Tue Sep 11 2007"
void read_nanoscope_date(std::string_view text, CurveMetadata& metadata) {
  constexpr std::array<std::string_view, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                     "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  std::vector<std::string_view> words;
  split(text, ' ', words);
  words.erase(std::remove(words.begin(), words.end(), std::string_view()), words.end());
  if (words.size() != 6 || words[0].size() != 8) return;
  const auto month = std::find(kMonths.begin(), kMonths.end(), words[3]);
  const auto hour = number_of(words[0].substr(0, 2)), day = number_of(words[4]), year = number_of(words[5]);
  if (month == kMonths.end() || !hour || !day || !year) return;
  if (!(*hour >= 1 && *hour <= 12 && *day >= 1 && *day <= 31 && *year >= 1900 && *year <= 9999)) return;
  const int hours = static_cast<int>(*hour) % 12 + (words[1] == "PM" ? 12 : 0);
  metadata.date =
      fmt::format("{:04}-{:02}-{:02}", static_cast<int>(*year), month - kMonths.begin() + 1, static_cast<int>(*day));
  metadata.time = fmt::format("{:02}{}", hours, words[0].substr(2));
}

CurveMetadata nanoscope_metadata(const NanoscopeBlocks& blocks) {
  CurveMetadata metadata;
  metadata.software = "NanoScope";
  if (const auto version = nanoscope_version(blocks); version != 0)
    metadata.software_version = fmt::format("0x{:08x}", version);
  for (const NanoscopeBlock& block : blocks) {
    const std::string name = lower_key(block.name);
    if (const auto* date = block.find("date"); date != nullptr && name == "force file list") {
      read_nanoscope_date(*date, metadata);
    }
    if (const auto* microscope = block.find("microscope"); microscope != nullptr && name == "equipment list") {
      metadata.instrument = *microscope;
    }
    if (name == kForceList && block.find("reverse delay") != nullptr) {
      if (const double delay_s = nanoscope_number(block, "reverse delay"); delay_s > 0.0) {
        remark_left_out(0, kBetweenBranches, "rests", delay_s, metadata);
      }
    }
  }
  return metadata;
}

}  // namespace

RecordedCurve read_nanoscope_curve(std::string_view bytes, const CurveReading& reading) {
  const NanoscopeBlocks blocks = nanoscope_blocks(bytes);
  const auto channels = force_channels(blocks);
  const NanoscopeBlock* deflection = channel_named(channels, {"deflection"});
  if (deflection == nullptr) {
    std::string names;
    for (const NanoscopeBlock* channel : channels) {
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", channel_name(*channel).substr(0, 40));
      if (names.size() > 200) break;
    }
    throw CurveError(fmt::format("it is a Nanoscope force curve without a deflection; its channels are {}",
                                 names.empty() ? "none" : names));
  }
  const BranchLengths lengths = branch_lengths(*deflection);
  RecordedCurve curve{{}, {}, nanoscope_metadata(blocks)};
  const double per_volt = newton_per_volt(*deflection, blocks, reading, curve.metadata);
  const ChannelIntegers volts = channel_integers(bytes, *deflection, lengths);
  const double factor = value_per_integer(*deflection, volts.integer_size) * per_volt;
  const auto [extend_m, retract_m] = ramp_heights(
      bytes, channel_named(channels, {"height sensor", "zsensor", "z sensor"}), *deflection, blocks, lengths);
  std::size_t unrecorded = 0;
  const auto add_branch = [&](const std::vector<double>& z, const std::vector<double>& signal, physics::Branch branch) {
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (std::isnan(z[i]) || std::isnan(signal[i])) {
        ++unrecorded;
        continue;
      }
      curve.points.push_back({physics::Length(z[i]), physics::Force(factor * signal[i]), branch});
    }
  };
  add_branch(extend_m, volts.extend, physics::Branch::Approach);
  add_branch(retract_m, volts.retract, physics::Branch::Retract);
  if (unrecorded > 0) {
    curve.metadata.remarks.push_back(fmt::format("{} of its {} points were not recorded: they are left out", unrecorded,
                                                 unrecorded + curve.points.size()));
  }
  return curve;
}

}  // namespace afm::curves
