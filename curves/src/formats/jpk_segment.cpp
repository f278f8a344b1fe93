// SPDX-License-Identifier: Apache-2.0
#include "formats/jpk_segment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bytes/text_table.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr std::size_t kMostChannelBytes = 8 * kMostCurvePoints;

// Storage of a channel's integers in its file.
struct Encoding {
  std::size_t bytes;
  bool is_signed;
};

Encoding encoding_of(const std::string& type) {
  if (type == "signedshort") return {2, true};
  if (type == "unsignedshort") return {2, false};
  if (type == "signedinteger") return {4, true};
  if (type == "unsignedinteger") return {4, false};
  if (type == "signedlong") return {8, true};
  throw CurveError(fmt::format("a channel is encoded as \"{}\", which is not understood", type.substr(0, 40)));
}

double big_endian(std::string_view bytes, Encoding encoding) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8U | static_cast<unsigned char>(byte);
  if (!encoding.is_signed) return static_cast<double>(value);
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
  const auto type = properties_.text("channel.vDeflection.data.encoder.type");
  const auto shared = properties_.text("channel.vDeflection.encoder.type");
  if ((!type && !shared) || !has("vDeflection")) return 0;
  return archive_.entry(data_file("vDeflection"), kMostChannelBytes).size() / encoding_of(type ? *type : *shared).bytes;
}

bool JpkSegment::has(std::string_view channel) const { return archive_.holds(data_file(channel)); }

std::vector<double> JpkSegment::values(std::string_view channel, const std::string& slot,
                                       const CurveReading& reading) const {
  const std::string prefix = fmt::format("channel.{}", channel);
  const auto encoder = [&](const char* key) {
    return properties_.text(prefix + ".data.encoder." + key) ? prefix + ".data.encoder." : prefix + ".encoder.";
  };
  const std::string scaling = encoder("type") + "scaling";
  const auto type = properties_.text(encoder("type") + "type");
  if (!type) throw CurveError(fmt::format("channel \"{}\" does not say how it is encoded", channel));
  const Encoding encoding = encoding_of(*type);
  std::vector<Linear> steps = conversions(prefix + ".conversion-set.conversion", base_slot(prefix), slot, reading);
  steps.push_back(linear_at(scaling));

  const std::string bytes = archive_.entry(data_file(channel), kMostChannelBytes);
  if (bytes.size() % encoding.bytes != 0) throw CurveError(fmt::format("channel \"{}\" is cut short", channel));
  std::vector<double> result;
  result.reserve(bytes.size() / encoding.bytes);
  for (std::size_t i = 0; i < bytes.size(); i += encoding.bytes) {
    double value = big_endian(std::string_view(bytes).substr(i, encoding.bytes), encoding);
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) value = (*step)(value);
    result.push_back(value);
  }
  return result;
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
  const bool no_sensitivity = !reading.sensitivity_m_per_v && properties_.text(prefix + ".distance.defined") != "true";
  return fmt::format("its lever is not calibrated; give {}{}", slot == "force" ? "--spring-constant" : "",
                     !no_sensitivity   ? ""
                     : slot == "force" ? " and --sensitivity"
                                       : "--sensitivity");
}

}  // namespace afm::curves
