// SPDX-License-Identifier: Apache-2.0
#include "formats/jpk_segment.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bytes/text_table.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr std::size_t kMostChannelBytes = 8 * kMostCurvePoints;

// Storage of a channel's numbers in its file, big-endian.
struct Encoding {
  std::size_t bytes;
  enum class Sort { Unsigned, Signed, Real } sort;
};

// Encoding of integers by their encoder's name. "signedshort-limited" has values beyond which nothing was recorded.
Encoding encoding_of(std::string_view type) {
  using Sort = Encoding::Sort;
  std::string_view name(type);
  constexpr std::string_view kLimited = "-limited";
  if (name.ends_with(kLimited)) name.remove_suffix(kLimited.size());
  if (name == "signedshort") return {2, Sort::Signed};
  if (name == "unsignedshort") return {2, Sort::Unsigned};
  if (name == "signedinteger") return {4, Sort::Signed};
  if (name == "unsignedinteger") return {4, Sort::Unsigned};
  if (name == "signedlong") return {8, Sort::Signed};
  if (name == "unsignedlong") return {8, Sort::Unsigned};
  throw CurveError(fmt::format("a channel is encoded as \"{}\", which is not understood", type.substr(0, 40)));
}

// Encoding of numbers without an encoder, as JPK's program writes them after a correction, by the type of the data.
std::optional<Encoding> real_of(std::string_view type) {
  if (type == "float-data" || type == "float") return Encoding{4, Encoding::Sort::Real};
  if (type == "double-data" || type == "double") return Encoding{8, Encoding::Sort::Real};
  return std::nullopt;
}

// True for data without a file: the same number repeated, or even steps.
bool is_computed(std::string_view type) { return type == "constant-data" || type == "raster-data"; }

double big_endian(std::string_view bytes, Encoding encoding) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8U | static_cast<unsigned char>(byte);
  if (encoding.sort == Encoding::Sort::Unsigned) return static_cast<double>(value);
  if (encoding.sort == Encoding::Sort::Real) {
    return bytes.size() == sizeof(double)
               ? std::bit_cast<double>(value)
               : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(value)));
  }
  const unsigned shift = static_cast<unsigned>(64 - 8 * bytes.size());
  return static_cast<double>(static_cast<std::int64_t>(value << shift)) / std::ldexp(1.0, static_cast<int>(shift));
}

}  // namespace

JpkSegment::JpkSegment(const ZipArchive& archive, std::string folder, JpkProperties properties)
    : archive_(archive), folder_(std::move(folder)), properties_(std::move(properties)) {}

std::string JpkSegment::style() const {
  for (const char* key :
       {"force-segment-header.settings.segment-settings.style", "force-segment-header.settings.style"}) {
    if (const auto style = properties_.text(key)) return *style;
  }
  throw CurveError("a segment does not say whether it extends or retracts");
}

std::size_t JpkSegment::points() const {
  return has("vDeflection") && storage_of("vDeflection") ? recorded("vDeflection").size() : 0;
}

bool JpkSegment::has(std::string_view channel) const {
  return archive_.holds(data_file(channel)) || is_computed(type_of(channel));
}

std::string JpkSegment::type_of(std::string_view channel) const {
  const auto own = properties_.text(fmt::format("channel.{}.data.type", channel));
  return own ? *own : properties_.text(fmt::format("channel.{}.type", channel)).value_or("");
}

std::optional<JpkSegment::Storage> JpkSegment::storage_of(std::string_view channel) const {
  for (const char* folder : {"data.", ""}) {
    std::string encoder = fmt::format("channel.{}.{}encoder.", channel, folder);
    if (auto type = properties_.text(encoder + "type")) return Storage{std::move(*type), std::move(encoder)};
  }
  std::string type = type_of(channel);
  if (!real_of(type) && !is_computed(type)) return std::nullopt;
  return Storage{std::move(type), ""};
}

std::vector<double> JpkSegment::computed(std::string_view channel, std::string_view type) const {
  const auto number = [&](const char* key) {
    const auto own = properties_.number(fmt::format("channel.{}.data.{}", channel, key));
    return own ? own : properties_.number(fmt::format("channel.{}.{}", channel, key));
  };
  const bool is_constant = type == "constant-data";
  const auto count = number("num-points"), first = number(is_constant ? "value" : "start");
  const auto step = is_constant ? std::optional(0.0) : number("step");
  if (!count || !first || !step || !(*count >= 0.0 && *count <= static_cast<double>(kMostCurvePoints))) {
    throw CurveError(fmt::format("channel \"{}\" is said to be {}, but not of which numbers", channel, type));
  }
  std::vector<double> values(static_cast<std::size_t>(*count));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = *first + static_cast<double>(i) * *step;
  return values;
}

std::vector<double> JpkSegment::recorded(std::string_view channel) const {
  const auto storage = storage_of(channel);
  if (!storage) throw CurveError(fmt::format("channel \"{}\" does not say how it is encoded", channel));
  const bool is_encoded = !storage->encoder.empty();
  if (!is_encoded && is_computed(storage->type)) return computed(channel, storage->type);
  const Encoding encoding = is_encoded ? encoding_of(storage->type) : *real_of(storage->type);
  const Linear decoded = is_encoded ? linear_at(storage->encoder + "scaling") : Linear();
  const std::string bytes = archive_.entry(data_file(channel), kMostChannelBytes);
  if (bytes.size() % encoding.bytes != 0)
    throw CurveError(fmt::format("channel \"{}\" is cut short; {}", channel, kCopyAgain));
  std::vector<double> values(bytes.size() / encoding.bytes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = decoded(big_endian(std::string_view(bytes).substr(i * encoding.bytes, encoding.bytes), encoding));
  }
  return values;
}

std::vector<double> JpkSegment::values(std::string_view channel, const std::string& slot,
                                       const CurveReading& reading) const {
  const std::string prefix = fmt::format("channel.{}", channel);
  const std::vector<Linear> steps =
      conversions(prefix + ".conversion-set.conversion", base_slot(prefix), slot, reading);
  std::vector<double> values = recorded(channel);
  for (double& value : values) {
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) value = (*step)(value);
  }
  return values;
}

std::vector<double> JpkSegment::heights(const CurveReading& reading) const {
  const auto read = [&](std::string_view channel, const char* usual) {
    return values(channel, slot_of(channel, usual), reading);
  };
  for (const char* sensor : {"strainGaugeHeight", "capacitiveSensorHeight", "measuredHeight"}) {
    if (has(sensor)) return read(sensor, "nominal");
  }
  for (const char* piezo : {"height", "head-height"}) {
    if (has(piezo)) return read(piezo, "calibrated");
  }
  const std::string all = properties_.text("channels.list").value_or("");
  std::vector<std::string_view> channels;
  split(all, ' ', channels);
  const auto other = std::find_if(channels.begin(), channels.end(), [&](std::string_view channel) {
    return (channel.ends_with("height") || channel.ends_with("Height")) && has(channel);
  });
  if (other == channels.end()) {
    throw CurveError(fmt::format("it has no channel of the height; its channels are \"{}\"", all.substr(0, 200)));
  }
  return read(*other, "calibrated");
}

std::optional<double> JpkSegment::calibration(const std::string& slot) const {
  return properties_.number("channel.vDeflection.conversion-set.conversion." + slot + ".scaling.multiplier");
}

JpkSegment::Linear JpkSegment::linear_at(const std::string& prefix) const {
  const auto offset = properties_.number(prefix + ".offset"), multiplier = properties_.number(prefix + ".multiplier");
  if (!offset || !multiplier) throw CurveError(fmt::format("\"{}\" has no offset and multiplier", prefix));
  return {*offset, *multiplier};
}

std::string JpkSegment::data_file(std::string_view channel) const {
  return fmt::format("{}channels/{}.dat", folder_, channel);
}

std::string JpkSegment::base_slot(const std::string& prefix) const {
  return properties_.text(prefix + ".conversion-set.conversions.base").value_or("volts");
}

std::string JpkSegment::slot_of(std::string_view channel, const char* usual) const {
  const std::string set = fmt::format("channel.{}.conversion-set.", channel);
  if (properties_.text(set + "conversion." + usual + ".defined") == "true") return usual;
  const auto shown = properties_.text(set + "conversions.default");
  return shown && *shown != base_slot(fmt::format("channel.{}", channel)) ? *shown : usual;
}

std::vector<JpkSegment::Linear> JpkSegment::conversions(const std::string& prefix, const std::string& base,
                                                        std::string slot, const CurveReading& reading) const {
  std::vector<Linear> steps;
  constexpr std::size_t kLongestChain = 8;
  while (slot != base) {
    if (steps.size() == kLongestChain) throw CurveError("its conversions lead nowhere");
    const std::string conversion = fmt::format("{}.{}", prefix, slot);
    if (slot == "force" && reading.spring_constant) {
      steps.push_back({0.0, reading.spring_constant->si});
      slot = "distance";
    } else if (slot == "distance" && reading.sensitivity_m_per_v) {
      steps.push_back({0.0, *reading.sensitivity_m_per_v});
      slot = base;
    } else if (properties_.text(conversion + ".defined") == "true") {
      steps.push_back(linear_at(conversion + ".scaling"));
      if (steps.back().multiplier == 0.0) throw CurveError(uncalibrated(prefix, slot, reading));
      slot = properties_.text(conversion + ".base-calibration-slot").value_or(base);
    } else {
      throw CurveError(uncalibrated(prefix, slot, reading));
    }
  }
  return steps;
}

std::string JpkSegment::uncalibrated(const std::string& prefix, const std::string& slot,
                                     const CurveReading& reading) const {
  if (slot != "force" && slot != "distance") return fmt::format("it does not say how to convert to \"{}\"", slot);
  const bool no_sensitivity =
      slot == "distance" || (!reading.sensitivity_m_per_v && properties_.text(prefix + ".distance.defined") != "true");
  return fmt::format("its lever is not calibrated; give {}{}", slot == "force" ? "--spring-constant" : "",
                     !no_sensitivity   ? ""
                     : slot == "force" ? " and --sensitivity"
                                       : "--sensitivity");
}

}  // namespace afm::curves
