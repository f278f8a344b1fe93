// SPDX-License-Identifier: Apache-2.0
#include "formats/touchafm_csv_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "bytes/spreadsheet_text.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

// Reads a comment. The number of samples is 0 in files of 0.1.0.
void read_comment(std::string_view line, const Lines& lines, CurveMetadata& metadata, double& samples) {
  constexpr std::string_view kSamplesLine = "# samples: ";
  constexpr std::string_view kSpringConstantLine = "# spring_constant_N_per_m: ", kMaterialLine = "# material: ",
                             kSoftwareLine = "# software: TouchAFM ";
  if (line.starts_with(kSpringConstantLine)) {
    metadata.spring_constant =
        physics::Stiffness(number_in(line.substr(kSpringConstantLine.size()), "spring_constant_N_per_m", lines));
  } else if (line.starts_with(kSamplesLine)) {
    samples = number_in(line.substr(kSamplesLine.size()), "samples", lines);
    return;
  } else if (line.starts_with(kMaterialLine)) {
    metadata.curve_id = line.substr(kMaterialLine.size());
  }
  if (line.starts_with(kSoftwareLine)) {
    metadata.software_version = line.substr(kSoftwareLine.size());
  } else if (!line.starts_with("# signs: ")) {
    add_parameter(line.substr(1), metadata);
  }
}

}  // namespace

RecordedCurve read_touchafm_csv(std::string_view bytes) {
  RecordedCurve curve;
  const auto undone = undo_spreadsheet(bytes, "z_m");
  if (undone) {
    bytes = *undone;
    curve.metadata.remarks.emplace_back(kSavedBySpreadsheet);
  }
  curve.metadata.instrument = curve.metadata.software = kComputedBy;
  Lines lines(bytes);
  std::string_view line;
  double samples = 0.0;
  bool more = lines.next(line);
  for (; more && (line.starts_with('#') || trimmed(line).empty()); more = lines.next(line))
    if (line.starts_with('#')) read_comment(line, lines, curve.metadata, samples);

  std::vector<std::string_view> names, fields;
  split(trimmed(line), ',', names);
  for (std::string_view& name : names) name = trimmed(name);
  const std::size_t z = column_in(names, "z_m"), force = column_in(names, "force_N"),
                    branch = column_in(names, "branch");
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    split(line, ',', fields);
    if (fields.size() != names.size()) refuse_fields(lines, fields.size(), names.size());
    fields[branch] = trimmed(fields[branch]);
    if (fields[branch].empty()) continue;  // row outside of the cycle in a session
    if (fields[branch] != "approach" && fields[branch] != "retract") {
      if (lines.is_open()) throw CutShort("its last line is not whole");
      throw CurveError(fmt::format("line {}: branch is \"{}\", neither approach nor retract", lines.number(),
                                   fields[branch].substr(0, 40)));
    }
    if (curve.points.size() == kMostCurvePoints) throw CurveError("it has more points than a curve may have");
    curve.points.push_back({physics::Length(number_in(fields[z], "z_m", lines)),
                            physics::Force(number_in(fields[force], "force_N", lines)),
                            fields[branch] == "approach" ? physics::Branch::Approach : physics::Branch::Retract});
  }
  // a complete cycle includes the way up, and its last line has a line end
  if (curve.points.empty() || curve.points.back().branch != physics::Branch::Retract ||
      !(bytes.ends_with('\n') || bytes.ends_with('\r'))) {
    const bool has_retract = std::any_of(curve.points.begin(), curve.points.end(),
                                         [](const auto& point) { return point.branch == physics::Branch::Retract; });
    if (has_retract && curve.points.back().branch == physics::Branch::Approach) {
      throw CutShort("its last row is of the approach, after rows of the retract (were its rows sorted?)");
    }
    throw CutShort();
  }
  if (const auto count = static_cast<double>(curve.points.size()); samples > 0.0 && count != samples) {
    throw CutShort(fmt::format("{} of {} samples are there", count, samples));
  }
  return curve;
}

}  // namespace afm::curves
