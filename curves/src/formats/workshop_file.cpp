// SPDX-License-Identifier: Apache-2.0
#include "formats/workshop_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bytes/spreadsheet_text.h"
#include "bytes/text_table.h"
#include "core/printable.h"
#include "core/version.h"
#include "curves/curve_error.h"
#include "curves/plot_units.h"
#include "formats/afmformats_metadata.h"

namespace afm::curves {

namespace {

constexpr std::array<std::string_view, 12> kMonths{"January",   "February", "March",    "April",
                                                   "May",       "June",     "July",     "August",
                                                   "September", "October",  "November", "December"};
constexpr std::array<std::string_view, 7> kWeekdays{"Sunday",   "Monday", "Tuesday", "Wednesday",
                                                    "Thursday", "Friday", "Saturday"};

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Converts "Friday, February 14, 2020" or "15 January 2021" to 2020-02-14; leaves any other date unchanged.
std::string iso_date(std::string_view text) {
  std::vector<std::string_view> words;
  split(trimmed(text), ' ', words);
  if (words.size() == 4) words.erase(words.begin());
  std::optional<int> day, year;
  std::size_t month = kMonths.size();
  for (std::string_view word : words) {
    while (word.ends_with(',')) word.remove_suffix(1);
    const auto named = std::find(kMonths.begin(), kMonths.end(), word);
    if (named != kMonths.end()) {
      month = static_cast<std::size_t>(named - kMonths.begin());
    } else {
      (day ? year : day) = whole_number(word);
    }
  }
  if (words.size() != 3 || !day || !year || month == kMonths.size()) return std::string(trimmed(text));
  return fmt::format("{:04}-{:02}-{:02}", *year, month + 1, *day);
}

// AFM Workshop's files always have a date, which Gwyddion and afmformats require. Curves without a date get this one,
// and reading it back gives none.
constexpr const char* kNoDate = "Thursday, January 1, 1970";
constexpr const char* kNoTime = "12:00:00 AM";

// Converts "2020-02-14" to "Friday, February 14, 2020"; empty for anything else.
std::string long_date(std::string_view iso) {
  std::vector<std::string_view> parts;
  split(iso, '-', parts);
  if (parts.size() != 3) return {};
  const auto year = whole_number(parts[0]), month = whole_number(parts[1]), day = whole_number(parts[2]);
  if (!year || !month || !day || *month < 1 || *day < 1) return {};
  const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return {};
  const std::chrono::weekday weekday{std::chrono::sys_days(date)};
  return fmt::format("{}, {} {}, {}", kWeekdays[weekday.c_encoding()], kMonths[static_cast<std::size_t>(*month - 1)],
                     *day, *year);
}

// Entries without a line in the format. Readers ignore unknown lines.
constexpr std::string_view kOwnLine = "TouchAFM ", kParameterLine = "TouchAFM made from ";

std::string own_lines(const RecordedCurve& curve) {
  static constexpr std::array<std::string_view, 7> kElsewhere{"imaging mode", "point count", "z range",        "date",
                                                              "time",         "sensitivity", "spring constant"};
  fmt::memory_buffer text;
  const auto add = [&text](std::string_view start, std::string_view key, std::string value) {
    // three commas would make it look like the line of column names
    if (std::count(value.begin(), value.end(), ',') >= 3) std::replace(value.begin(), value.end(), ',', ';');
    fmt::format_to(std::back_inserter(text), "{}{}:\t{}\r\n", start, key, value);
  };
  add(kOwnLine, "version", core::kVersion);
  const nlohmann::ordered_json metadata = afmformats_metadata(curve);
  for (const auto& [key, value] : metadata.items()) {
    if (std::find(kElsewhere.begin(), kElsewhere.end(), key) != kElsewhere.end()) continue;
    add(kOwnLine, key, value.is_string() ? core::printable_line(value.get<std::string>()) : value.dump());
  }
  for (const auto& [key, value] : curve.metadata.parameters) add(kParameterLine, key, value);
  return fmt::to_string(text);
}

// Beginnings of the keys whose values are numbers.
constexpr std::array<std::string_view, 4> kOwnNumbers{"setpoint", "speed ", "position ", "grid "};

// Reads a line of own_lines(): a parameter, or a key of afmformats for `entries`.
void read_own_line(std::string_view line, CurveMetadata& metadata, nlohmann::json& entries) {
  if (line.starts_with(kParameterLine)) {
    std::string parameter(line.substr(kParameterLine.size()));
    std::replace(parameter.begin(), parameter.end(), '\t', ' ');
    add_parameter(parameter, metadata);
    return;
  }
  line.remove_prefix(kOwnLine.size());
  const std::size_t colon = line.find(":\t");
  if (colon == std::string_view::npos) return;
  const std::string key(line.substr(0, colon)), value(line.substr(colon + 2));
  const auto number = number_of(value);
  const auto begins_key = [&key](std::string_view beginning) { return key.starts_with(beginning); };
  // a name may look like a number
  const bool is_number = number && std::any_of(kOwnNumbers.begin(), kOwnNumbers.end(), begins_key);
  entries[key] = is_number ? nlohmann::json(*number) : nlohmann::json(value);
}

// AFM Workshop writes 1 for a missing calibration, so a true 1 is written slightly larger.
double never_one(double value) { return value == 1.0 ? std::nextafter(1.0, 2.0) : value; }

// Name of a column that marks the line of them; a comment may have commas too.
constexpr std::string_view kFirstColumn = "Extend Z-Sense(nm)";

struct Header {
  CurveMetadata metadata;
  std::vector<std::string_view> columns;
};

Header read_header(Lines& lines) {
  Header header;
  header.metadata.instrument = header.metadata.software = "AFM Workshop";
  nlohmann::json entries = nlohmann::json::object();
  for (std::string_view line; lines.next(line);) {
    const auto value_of = [&](std::string_view key) {
      return line.starts_with(key) ? trimmed(line.substr(key.size())) : std::string_view();
    };
    // "1" marks a missing calibration (for afmformats too)
    const auto calibration = [&](std::string_view key) -> std::optional<double> {
      const std::string_view text = value_of(key);
      if (text.empty()) return std::nullopt;
      const double value = number_in(text, key, lines);
      return value == 1.0 ? std::nullopt : std::optional(value);
    };
    if (const auto date = value_of("Date:"); !date.empty() && date != kNoDate) header.metadata.date = iso_date(date);
    if (const auto time = value_of("Time:"); !time.empty() && time != kNoTime) header.metadata.time = time;
    if (const auto version = value_of("Software Version:"); !version.empty())
      header.metadata.software_version = version;
    if (const auto gain = calibration("Light Lever Gain, mV/nm:")) header.metadata.sensitivity_m_per_v = 1e-6 / *gain;
    if (const auto k = calibration("Force Constant, nN/nm:")) header.metadata.spring_constant = physics::Stiffness(*k);
    if (line.starts_with(kOwnLine)) {
      read_own_line(line, header.metadata, entries);
      continue;
    }
    split(line, ',', header.columns);
    for (std::string_view& name : header.columns) name = trimmed(name);
    if (std::find(header.columns.begin(), header.columns.end(), kFirstColumn) == header.columns.end()) continue;
    read_afmformats_metadata(entries, header.metadata);
    return header;
  }
  throw CurveError(fmt::format("it has no line of column names, one of which is \"{}\"", kFirstColumn));
}

// Columns of one of the two branches of the table.
struct Columns {
  std::size_t height;
  std::size_t signal;
  double newton_per_signal;
};

// A calibration for volts comes from the header, otherwise from `reading`.
Columns columns_of(Header& header, std::string_view branch, const CurveReading& reading) {
  const auto has = [&](const std::string& name) {
    return std::find(header.columns.begin(), header.columns.end(), name) != header.columns.end();
  };
  const std::size_t height = column_in(header.columns, fmt::format("{} Z-Sense(nm)", branch));
  const std::string force = fmt::format("{} Force(nN)", branch), volts = fmt::format("{} T-B(V)", branch);
  if (has(force)) return {height, column_in(header.columns, force), 1.0 / kNnPerN};
  const std::size_t signal = column_in(header.columns, volts);
  CurveMetadata& made = header.metadata;
  if (!made.sensitivity_m_per_v) made.sensitivity_m_per_v = reading.sensitivity_m_per_v;
  if (!made.spring_constant) made.spring_constant = reading.spring_constant;
  if (!made.sensitivity_m_per_v || !made.spring_constant) {
    throw CurveError("its deflection is in volts; give --sensitivity and --spring-constant");
  }
  return {height, signal, *made.sensitivity_m_per_v * made.spring_constant->si};
}

// Returns whether Gwyddion may take the heights as evenly spaced, within the digits that AFM Workshop writes.
bool evenly_spaced(std::span<const physics::CurvePoint> branch) {
  const double step = (branch.back().z - branch.front().z).si / static_cast<double>(branch.size() - 1);
  for (std::size_t i = 0; i < branch.size(); ++i) {
    const double place = branch.front().z.si + static_cast<double>(i) * step;
    if (std::abs(branch[i].z.si - place) > 1e-3 * std::abs(step)) return false;
  }
  return true;
}

// The branch at `count` evenly spaced heights from its first to its last point, interpolated linearly.
std::vector<physics::CurvePoint> resampled(std::span<const physics::CurvePoint> branch, std::size_t count) {
  std::vector<physics::CurvePoint> rising(branch.begin(), branch.end());
  if (rising.front().z > rising.back().z) std::reverse(rising.begin(), rising.end());
  std::stable_sort(rising.begin(), rising.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  std::vector<physics::CurvePoint> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    const physics::Length z = branch.front().z + share * (branch.back().z - branch.front().z);
    const auto above =
        std::lower_bound(rising.begin(), rising.end(), z, [](const auto& point, auto at) { return point.z < at; });
    physics::Force force = above == rising.end() ? rising.back().force : above->force;
    if (above != rising.begin() && above != rising.end() && above->z > z) {
      const physics::CurvePoint& below = *(above - 1);
      force = below.force + (z - below.z) / (above->z - below.z) * (above->force - below.force);
    }
    result.push_back({z, force, branch.front().branch});
  }
  return result;
}

}  // namespace

std::string workshop_bytes(const RecordedCurve& curve) {
  const auto turn = std::find_if(curve.points.begin(), curve.points.end(),
                                 [](const auto& point) { return point.branch == physics::Branch::Retract; });
  std::vector<physics::CurvePoint> approach(curve.points.begin(), turn), retract(turn, curve.points.end());
  if (approach.size() < 2 || retract.size() < 2) throw CurveError("it needs an approach and a retract");
  if (approach.size() != retract.size() || !evenly_spaced(approach) || !evenly_spaced(retract)) {
    const std::size_t count = std::max(approach.size(), retract.size());
    approach = resampled(approach, count);
    retract = resampled(retract, count);
  }

  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "Force-Distance Curve\r\nFile Format:\t3\r\n\r\n");
  const std::string date = long_date(curve.metadata.date);
  fmt::format_to(out, "Date:\t{}\r\n", date.empty() ? kNoDate : date);
  fmt::format_to(out, "Time:\t{}\r\n", curve.metadata.time.empty() ? kNoTime : curve.metadata.time);
  fmt::format_to(out, "Mode:\tSingle\r\nPoint:\t0\r\nX, um:\t0.000000\r\nY, um:\t0.000000\r\n");
  if (const auto& k = curve.metadata.spring_constant) {
    fmt::format_to(out, "Force Constant, nN/nm:\t{}\r\n", never_one(k->si));
  }
  if (const auto& sensitivity = curve.metadata.sensitivity_m_per_v) {
    fmt::format_to(out, "Light Lever Gain, mV/nm:\t{}\r\n", never_one(1e-6 / *sensitivity));
  }
  fmt::format_to(out, "{}", own_lines(curve));
  fmt::format_to(out, "\r\nExtend Z-Sense(nm),Extend Force(nN),Retract Z-Sense(nm),Retract Force(nN)\r\n");
  for (std::size_t i = 0; i < approach.size(); ++i) {
    fmt::format_to(out, "{},{},{},{}\r\n", -kNmPerM * approach[i].z.si + 0.0, kNnPerN * approach[i].force.si + 0.0,
                   -kNmPerM * retract[i].z.si + 0.0, kNnPerN * retract[i].force.si + 0.0);
  }
  return fmt::to_string(text);
}

RecordedCurve read_workshop(std::string_view bytes, const CurveReading& reading) {
  const auto undone = undo_spreadsheet(bytes, kFirstColumn);
  if (undone) bytes = *undone;
  Lines lines(bytes);
  Header header = read_header(lines);
  if (undone) header.metadata.remarks.emplace_back(kSavedBySpreadsheet);
  const Columns extend = columns_of(header, "Extend", reading), pull = columns_of(header, "Retract", reading);

  RecordedCurve curve{{}, {}, header.metadata};
  std::vector<physics::CurvePoint> retract;
  std::vector<std::string_view> fields;
  std::size_t row = 0;
  for (std::string_view line; lines.next(line);) {
    if (trimmed(line).empty()) continue;
    split(line, ',', fields);
    if (fields.size() != header.columns.size()) refuse_fields(lines, fields.size(), header.columns.size());
    if (2 * row >= kMostCurvePoints) throw CurveError("it has more points than a curve may have");
    const auto add_point = [&](const Columns& columns, physics::Branch branch, std::vector<physics::CurvePoint>& to) {
      // the shorter branch has empty fields behind its end
      if (trimmed(fields[columns.height]).empty() && trimmed(fields[columns.signal]).empty()) return;
      if (to.size() < row) {
        throw CurveError(fmt::format("line {}: the {} goes on behind empty fields", lines.number(),
                                     branch == physics::Branch::Approach ? "approach" : "retract"));
      }
      to.push_back({physics::Length(-number_in(fields[columns.height], "Z-Sense", lines) / kNmPerM),
                    physics::Force(number_in(fields[columns.signal], "force", lines) * columns.newton_per_signal),
                    branch});
    };
    add_point(extend, physics::Branch::Approach, curve.points);
    add_point(pull, physics::Branch::Retract, retract);
    ++row;
  }
  curve.points.insert(curve.points.end(), retract.begin(), retract.end());
  if (lines.is_open()) curve.metadata.remarks.emplace_back("its last line has no end, and may have lost digits");
  return curve;
}

}  // namespace afm::curves
