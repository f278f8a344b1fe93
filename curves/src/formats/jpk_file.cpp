// SPDX-License-Identifier: Apache-2.0
#include "formats/jpk_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "bytes/text_table.h"
#include "core/file_kind.h"
#include "curves/curve_error.h"
#include "curves/unread_kinds.h"
#include "formats/jpk_segment.h"
#include "formats/segments.h"

namespace afm::curves {

namespace {

constexpr std::size_t kMostPropertyBytes = std::size_t{4} << 20U;
constexpr int kMostSegments = 64;
constexpr std::string_view kIndexFolder = "index/";

void add_segment(const JpkSegment& segment, physics::Branch branch, const CurveReading& reading, RecordedCurve& curve) {
  const std::vector<double> z = segment.heights(reading), force = segment.values("vDeflection", "force", reading);
  if (z.size() != force.size()) throw CurveError("the channels of a segment differ in length");
  if (curve.points.size() + z.size() > kMostCurvePoints) throw CurveError("it has more points than a curve may have");
  curve.points.reserve(curve.points.size() + z.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    curve.points.push_back({physics::Length(z[i]), physics::Force(force[i]), branch});
  }
}

// Leaves a segment out in which the tip neither approaches nor retracts, with a remark unless nothing was recorded.
void leave_out(const JpkSegment& segment, const std::string& style, RecordedCurve& curve) {
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

std::optional<CurvePosition> position_in(const JpkProperties& properties) {
  for (const char* kind : {"force-scan-series", "quantitative-imaging-series"}) {
    const std::string prefix = fmt::format("{}.header.position.", kind);
    const auto x = properties.number(prefix + "x"), y = properties.number(prefix + "y");
    if (x && y) return CurvePosition{*x, *y};
  }
  return std::nullopt;
}

// Pixel of the curve at `position` in the map's grid, whatever the order of recording, in which a map may go back and
// forth.
std::optional<MapPixel> pixel_in(const JpkProperties& properties, const CurvePosition& position) {
  for (const char* kind : {"force-scan-map", "quantitative-imaging-map"}) {
    const std::string prefix = fmt::format("{}.position-pattern.grid.", kind);
    const auto number = [&](const char* key) { return properties.number(prefix + key); };
    const auto columns = number("ilength"), rows = number("jlength");
    const auto width = number("ulength"), height = number("vlength");
    const auto is_side = [](const std::optional<double>& side) {
      return side && *side >= 1.0 && *side <= static_cast<double>(kMostMapSide);
    };
    if (!is_side(columns) || !is_side(rows) || !(width && *width > 0.0 && height && *height > 0.0)) continue;
    const MapGrid grid{static_cast<std::size_t>(*columns), static_cast<std::size_t>(*rows), *width, *height,
                       number("xcenter").value_or(0.0),    number("ycenter").value_or(0.0)};
    return pixel_at(position, grid, number("theta").value_or(0.0), properties.text(prefix + "reflect") == "true");
  }
  return std::nullopt;
}

void read_metadata(const JpkSegment& segment, const CurveReading& reading, CurveMetadata& metadata) {
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
  metadata.position = position_in(segment.properties());
  if (metadata.position) metadata.pixel = pixel_in(segment.properties(), *metadata.position);
  // "2016-03-31 17:51:14.543 +0200"
  std::vector<std::string_view> words;
  const std::string stamp = segment.properties().text("force-segment-header.time-stamp").value_or("");
  split(stamp, ' ', words);
  if (words.size() < 2) return;
  metadata.date = words[0];
  metadata.time = words[1];
}

// Index of the curve that a name begins: "index/12/segments/0/segment-header.properties" begins curve 12.
std::optional<std::size_t> curve_begun_by(std::string_view name) {
  if (!name.starts_with(kIndexFolder)) return std::nullopt;
  name.remove_prefix(kIndexFolder.size());
  std::size_t number = 0;
  const auto read = std::from_chars(name.data(), name.data() + name.size(), number);
  name.remove_prefix(static_cast<std::size_t>(read.ptr - name.data()));
  return read.ec == std::errc() && name == "/segments/0/segment-header.properties" ? std::optional(number)
                                                                                   : std::nullopt;
}

}  // namespace

JpkArchive::JpkArchive(std::string_view bytes)
    : archive_(bytes,
               [this](std::string_view name) {
                 if (const auto number = curve_begun_by(name)) folders_.push_back(*number);
               }),
      is_map_(!folders_.empty()) {
  const bool has_header = archive_.holds("header.properties");
  if (!is_map_ && !has_header) {
    const auto kind = core::file_kind(bytes.substr(0, core::kFileKindBytes), bytes.size());
    if (kind && kind->role == core::FileRole::Spreadsheet) refuse_no_text(bytes);
    throw CurveError("it is a zip archive, but not one of JPK's; unpack it first");
  }
  if (!is_map_) folders_.push_back(0);
  std::sort(folders_.begin(), folders_.end());
  if (has_header) general_.add(archive_.entry("header.properties", kMostPropertyBytes));
  if (archive_.holds("shared-data/header.properties")) {
    shared_.add(archive_.entry("shared-data/header.properties", kMostPropertyBytes));
  }
}

RecordedCurve JpkArchive::curve(std::size_t index, const CurveReading& reading) const {
  const std::string folder = is_map_ ? fmt::format("{}{}/", kIndexFolder, folders_.at(index)) : "";
  std::string header;
  if (is_map_ && archive_.holds(folder + "header.properties")) {
    header = archive_.entry(folder + "header.properties", kMostPropertyBytes);
  }
  RecordedCurve curve;
  for (int i = 0;; ++i) {
    const std::string part = fmt::format("{}segments/{}/", folder, i);
    if (!archive_.holds(part + "segment-header.properties")) break;
    if (i == kMostSegments) throw CurveError(fmt::format("it has more than {} segments", kMostSegments));
    JpkProperties properties;
    properties.add(archive_.entry(part + "segment-header.properties", kMostPropertyBytes));
    properties.set_shared(shared_);
    properties.add(header);
    properties.set_general(general_);
    const JpkSegment segment(archive_, part, std::move(properties));
    const std::string style = segment.style();
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
