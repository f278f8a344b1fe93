// SPDX-License-Identifier: Apache-2.0
#include "formats/jpk_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "curves/curve_error.h"
#include "formats/jpk_properties.h"
#include "formats/segments.h"
#include "formats/text_table.h"
#include "formats/zip_archive.h"

namespace afm::curves {

namespace {

constexpr std::size_t kMostPropertyBytes = std::size_t{4} << 20U;
constexpr int kMostSegments = 64;
constexpr std::size_t kMostChannelBytes = 8 * kMostCurvePoints;

struct Linear {
  double offset = 0;
  double multiplier = 1;
  double operator()(double value) const { return multiplier * value + offset; }
};

Linear linear_at(const JpkProperties& properties, const std::string& prefix) {
  const auto offset = properties.number(prefix + ".offset"), multiplier = properties.number(prefix + ".multiplier");
  if (!offset || !multiplier) throw CurveError(fmt::format("\"{}\" has no offset and multiplier", prefix));
  return {*offset, *multiplier};
}

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

class Segment {
 public:
  Segment(const ZipArchive& archive, std::string folder, JpkProperties properties)
      : archive_(archive), folder_(std::move(folder)), properties_(std::move(properties)) {}

  const JpkProperties& properties() const { return properties_; }

  // Number of points of the deflection; 0 if it was not recorded.
  std::size_t points() const {
    const auto type = properties_.text("channel.vDeflection.data.encoder.type");
    const auto shared = properties_.text("channel.vDeflection.encoder.type");
    if ((!type && !shared) || !has("vDeflection")) return 0;
    return archive_.entry(data_file("vDeflection"), kMostChannelBytes).size() /
           encoding_of(type ? *type : *shared).bytes;
  }

  bool has(std::string_view channel) const { return archive_.holds(data_file(channel)); }

  // The channel's values converted to a slot: "volts", or the result of the chain of conversions.
  std::vector<double> values(std::string_view channel, const std::string& slot, const CurveReading& reading) const {
    const std::string prefix = fmt::format("channel.{}", channel);
    const auto encoder = [&](const char* key) {
      return properties_.text(prefix + ".data.encoder." + key) ? prefix + ".data.encoder." : prefix + ".encoder.";
    };
    const std::string scaling = encoder("type") + "scaling";
    const auto type = properties_.text(encoder("type") + "type");
    if (!type) throw CurveError(fmt::format("channel \"{}\" does not say how it is encoded", channel));
    const Encoding encoding = encoding_of(*type);
    std::vector<Linear> steps = conversions(prefix + ".conversion-set.conversion", base_slot(prefix), slot, reading);
    steps.push_back(linear_at(properties_, scaling));

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

  // The usual conversion of a channel, or, where it is not defined, the one that the file itself shows by default.
  std::string slot_of(std::string_view channel, const char* usual) const {
    const std::string set = fmt::format("channel.{}.conversion-set.", channel);
    if (properties_.text(set + "conversion." + usual + ".defined") == "true") return usual;
    const auto shown = properties_.text(set + "conversions.default");
    return shown && *shown != base_slot(fmt::format("channel.{}", channel)) ? *shown : usual;
  }

  // The factor of a conversion of the deflection, if it is defined: the lever's calibration.
  std::optional<double> calibration(const std::string& slot) const {
    return properties_.number("channel.vDeflection.conversion-set.conversion." + slot + ".scaling.multiplier");
  }

 private:
  std::string data_file(std::string_view channel) const { return fmt::format("{}channels/{}.dat", folder_, channel); }

  std::string base_slot(const std::string& prefix) const {
    return properties_.text(prefix + ".conversion-set.conversions.base").value_or("volts");
  }

  // The chain from the slot back to the base. A given calibration replaces the file's.
  std::vector<Linear> conversions(const std::string& prefix, const std::string& base, std::string slot,
                                  const CurveReading& reading) const {
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
        steps.push_back(linear_at(properties_, conversion + ".scaling"));
        slot = properties_.text(conversion + ".base-calibration-slot").value_or(base);
      } else {
        throw CurveError(uncalibrated(prefix, slot, reading));
      }
    }
    return steps;
  }

  std::string uncalibrated(const std::string& prefix, const std::string& slot, const CurveReading& reading) const {
    if (slot != "force" && slot != "distance") return fmt::format("it does not say how to convert to \"{}\"", slot);
    const bool no_sensitivity =
        !reading.sensitivity_m_per_v && properties_.text(prefix + ".distance.defined") != "true";
    return fmt::format("its lever is not calibrated; give {}{}", slot == "force" ? "--spring-constant" : "",
                       !no_sensitivity   ? ""
                       : slot == "force" ? " and --sensitivity"
                                         : "--sensitivity");
  }

  const ZipArchive& archive_;
  std::string folder_;
  JpkProperties properties_;
};

// The height by its sensor, otherwise by a piezo, at last by the stage of a CellHesion or any other channel that is
// called a height.
std::vector<double> heights(const Segment& segment, const CurveReading& reading) {
  const auto read = [&](std::string_view channel, const char* usual) {
    return segment.values(channel, segment.slot_of(channel, usual), reading);
  };
  for (const char* sensor : {"strainGaugeHeight", "capacitiveSensorHeight", "measuredHeight"}) {
    if (segment.has(sensor)) return read(sensor, "nominal");
  }
  for (const char* piezo : {"height", "head-height"}) {
    if (segment.has(piezo)) return read(piezo, "calibrated");
  }
  const std::string all = segment.properties().text("channels.list").value_or("");
  std::vector<std::string_view> channels;
  split(all, ' ', channels);
  const auto other = std::find_if(channels.begin(), channels.end(), [&](std::string_view channel) {
    return (channel.ends_with("height") || channel.ends_with("Height")) && segment.has(channel);
  });
  if (other == channels.end()) {
    throw CurveError(fmt::format("it has no channel of the height; its channels are \"{}\"", all.substr(0, 200)));
  }
  return read(*other, "calibrated");
}

std::string style_of(const Segment& segment) {
  for (const char* key :
       {"force-segment-header.settings.segment-settings.style", "force-segment-header.settings.style"}) {
    if (const auto style = segment.properties().text(key)) return *style;
  }
  throw CurveError("a segment does not say whether it extends or retracts");
}

void add_segment(const Segment& segment, physics::Branch branch, const CurveReading& reading, RecordedCurve& curve) {
  const std::vector<double> z = heights(segment, reading), force = segment.values("vDeflection", "force", reading);
  if (z.size() != force.size()) throw CurveError("the channels of a segment differ in length");
  if (curve.points.size() + z.size() > kMostCurvePoints) throw CurveError("it has more points than a curve may have");
  for (std::size_t i = 0; i < z.size(); ++i) {
    curve.points.push_back({physics::Length(z[i]), physics::Force(force[i]), branch});
  }
}

// Leaves a segment out in which the tip neither approaches nor retracts, with a remark unless nothing was recorded.
void leave_out(const Segment& segment, const std::string& style, RecordedCurve& curve) {
  const JpkProperties& properties = segment.properties();
  const auto duration_s = properties.number("force-segment-header.duration");
  const std::size_t points = segment.points();
  if (points == 0 && duration_s.value_or(0.0) <= 0.0) return;
  const auto type = properties.text("force-segment-header.settings.segment-settings.type").value_or("");
  const std::string held = type == "constant-height-pause"  ? "rests at constant height"
                           : type == "constant-force-pause" ? "rests at constant force"
                                                            : "rests";
  const char* when = curve.points.empty()                                      ? kBeforeApproach
                     : curve.points.back().branch == physics::Branch::Approach ? kBetweenBranches
                                                                               : kAfterRetract;
  remark_left_out(points, when, style == "pause" ? held : fmt::format("is in a segment \"{}\"", style.substr(0, 40)),
                  duration_s, curve.metadata);
}

void read_metadata(const Segment& segment, const CurveReading& reading, CurveMetadata& metadata) {
  metadata.software = "JPK";
  metadata.sensitivity_m_per_v =
      reading.sensitivity_m_per_v ? reading.sensitivity_m_per_v : segment.calibration("distance");
  if (const auto k = segment.calibration("force")) metadata.spring_constant = physics::Stiffness(*k);
  if (reading.spring_constant) metadata.spring_constant = reading.spring_constant;
  for (const char* kind : {"force-scan-series", "force-scan-map", "quantitative-imaging-map"}) {
    const std::string description = fmt::format("{}.description.", kind);
    if (const auto text = segment.properties().text(description + "instrument")) metadata.instrument = *text;
    if (const auto text = segment.properties().text(description + "source-software")) metadata.software_version = *text;
  }
  // "2016-03-31 17:51:14.543 +0200"
  std::vector<std::string_view> words;
  const std::string stamp = segment.properties().text("force-segment-header.time-stamp").value_or("");
  split(stamp, ' ', words);
  if (words.size() < 2) return;
  metadata.date = words[0];
  metadata.time = words[1];
}

}  // namespace

RecordedCurve read_jpk(std::string_view bytes, const CurveReading& reading) {
  const ZipArchive archive(bytes);
  if (archive.holds_folder("index/")) {
    throw CurveError("it is a map or QI file of many curves; export one of them as .jpk-force or .tab");
  }
  if (!archive.holds("header.properties")) throw CurveError("it is a zip archive, but not one of JPK's");
  const std::string general = archive.entry("header.properties", kMostPropertyBytes);
  JpkProperties shared;
  if (archive.holds("shared-data/header.properties")) {
    shared.add(archive.entry("shared-data/header.properties", kMostPropertyBytes));
  }

  RecordedCurve curve;
  for (int i = 0;; ++i) {
    const std::string folder = fmt::format("segments/{}/", i);
    if (!archive.holds(folder + "segment-header.properties")) break;
    if (i == kMostSegments) throw CurveError(fmt::format("it has more than {} segments", kMostSegments));
    JpkProperties properties;
    properties.add(archive.entry(folder + "segment-header.properties", kMostPropertyBytes));
    properties.take_shared(shared);
    properties.add(general);
    const Segment segment(archive, folder, std::move(properties));
    const std::string style = style_of(segment);
    if (style != "extend" && style != "retract") {
      leave_out(segment, style, curve);
      continue;
    }
    if (curve.points.empty()) read_metadata(segment, reading, curve.metadata);
    add_segment(segment, style == "extend" ? physics::Branch::Approach : physics::Branch::Retract, reading, curve);
  }
  return curve;
}

}  // namespace afm::curves
