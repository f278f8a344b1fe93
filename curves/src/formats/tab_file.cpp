// SPDX-License-Identifier: Apache-2.0
#include "formats/tab_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bytes/text_table.h"
#include "core/printable.h"
#include "core/written_by.h"
#include "curves/curve_error.h"
#include "formats/afmformats_metadata.h"
#include "formats/segments.h"

namespace afm::curves {

namespace {

constexpr std::string_view kBegin = "BEGIN METADATA", kRemark = "# TouchAFM remarks: ";

// The # lines at the top: the curve's inputs, the metadata, and in the last line the column names.
struct Heading {
  CurveMetadata made_from;
  std::string metadata;
  std::string_view columns;
  bool has_metadata = false;
};

Heading read_heading(Lines& lines, std::string_view& first_row) {
  Heading heading;
  bool inside = false;
  for (std::string_view line; lines.next(line);) {
    if (line.starts_with('#') && trimmed(line.substr(1)).starts_with(kBegin)) {
      inside = true;
    } else if (line.starts_with("# END METADATA")) {
      inside = false;
      heading.has_metadata = true;
    } else if (inside && line.starts_with('#')) {
      heading.metadata.append(line.substr(1)).push_back('\n');
    } else if (line.starts_with(kRemark)) {
      if (heading.made_from.remarks.size() < kMostRemarks) {
        heading.made_from.remarks.push_back(core::printable_line(line.substr(kRemark.size())));
      }
    } else if (line.starts_with('#')) {
      if (!trimmed(line.substr(1)).empty()) heading.columns = trimmed(line.substr(1));
      if (!heading.has_metadata) add_parameter(line.substr(1), heading.made_from);
    } else if (!trimmed(line).empty()) {
      first_row = line;
      break;
    }
  }
  if (!heading.has_metadata) throw CurveError("it has no block between BEGIN METADATA and END METADATA");
  return heading;
}

double segment_in(std::string_view field, const Lines& lines) {
  field = trimmed(field);
  if (field == "False") return 0.0;
  if (field == "True") return 1.0;
  return number_in(field, "segment", lines);
}

void check_count(const nlohmann::json& metadata, std::size_t points, std::string_view bytes) {
  const auto count = metadata.find("point count");
  if (count == metadata.end() || !count->is_number()) return;
  const double expected = count->get<double>();
  // a last line without a line end may have lost digits
  if (static_cast<double>(points) < expected)
    throw CutShort(fmt::format("{} of {} points are there", points, expected));
  if (!bytes.ends_with('\n') && !bytes.ends_with('\r'))
    throw CurveError("its last line has no end, and may have lost digits; add a line end if it is whole");
}

void put_heading(const RecordedCurve& curve, fmt::memory_buffer& text) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# {}\n", core::written_by());
  for (const auto& [key, value] : curve.metadata.parameters) {
    if (!key.starts_with(kBegin)) fmt::format_to(out, "# {}: {}\n", key, value);
  }
  for (const std::string& remark : curve.metadata.remarks) fmt::format_to(out, "{}{}\n", kRemark, remark);
  fmt::format_to(out, "#\n# {}\n", kBegin);
  const std::string metadata = afmformats_metadata(curve).dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string_view line;
  for (Lines lines(metadata); lines.next(line);) fmt::format_to(out, "# {}\n", line);
  fmt::format_to(out, "# END METADATA\n#\n# force\theight (measured)\tsegment{}\n",
                 curve.time_s.empty() ? "" : "\ttime");
}

}  // namespace

std::string tab_bytes(const RecordedCurve& curve) {
  fmt::memory_buffer text;
  put_heading(curve, text);
  const auto out = std::back_inserter(text);
  const bool timed = !curve.time_s.empty();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const physics::CurvePoint& point = curve.points[i];
    // adding zero turns -0 into 0
    fmt::format_to(out, "{}\t{}\t{}", point.force.si + 0.0, point.z.si + 0.0,
                   point.branch == physics::Branch::Approach ? 0 : 1);
    if (timed) fmt::format_to(out, "\t{}", curve.time_s[i]);
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

RecordedCurve read_tab(std::string_view bytes) {
  Lines lines(bytes);
  std::string_view line;
  const Heading heading = read_heading(lines, line);
  const nlohmann::json metadata = nlohmann::json::parse(heading.metadata);
  RecordedCurve curve;
  curve.metadata = heading.made_from;
  read_afmformats_metadata(metadata, curve.metadata);

  std::vector<std::string_view> names, fields;
  split(heading.columns, '\t', names);
  const bool measured = std::find(names.begin(), names.end(), "height (measured)") != names.end();
  const std::size_t height = column_in(names, measured ? "height (measured)" : "height (piezo)");
  const std::size_t force = column_in(names, "force"), segment = column_in(names, "segment");
  const std::size_t time = static_cast<std::size_t>(std::find(names.begin(), names.end(), "time") - names.begin());
  // afmformats 0.13 appended its first row to the heading, which then has more columns than the rows
  const std::size_t last_used = std::max({height, force, segment, time < names.size() ? time : 0});
  std::vector<double> segments;
  for (bool more = !line.empty(); more; more = lines.next(line)) {
    if (trimmed(line).empty() || line.starts_with('#')) continue;
    split(line, '\t', fields);
    if (fields.size() <= last_used || fields.size() > names.size()) {
      refuse_fields(lines, fields.size(), names.size());
    }
    if (curve.points.size() == kMostCurvePoints) throw CurveError("it has more points than a curve may have");
    curve.points.push_back({physics::Length(number_in(fields[height], "height", lines)),
                            physics::Force(number_in(fields[force], "force", lines))});
    segments.push_back(segment_in(fields[segment], lines));
    if (time < fields.size()) curve.time_s.push_back(number_in(fields[time], "time", lines));
  }
  check_count(metadata, curve.points.size(), bytes);
  assign_branches(segments, curve);
  return curve;
}

}  // namespace afm::curves
