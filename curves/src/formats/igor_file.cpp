// SPDX-License-Identifier: Apache-2.0
#include "formats/igor_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bytes/igor_wave.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"
#include "formats/segments.h"

namespace afm::curves {

namespace {

// Asylum's program appends a text that ends with its own length and kind, "0292 Force".
void check_curve_trailer(std::string_view trailer) {
  if (trailer.empty()) return;
  std::size_t letters = 0, digits = 0;
  const auto last = [&](std::size_t back) { return back < trailer.size() ? trailer[trailer.size() - 1 - back] : '\0'; };
  while (std::isalpha(static_cast<unsigned char>(last(letters))) != 0) ++letters;
  while (std::isdigit(static_cast<unsigned char>(last(letters + 1 + digits))) != 0) ++digits;
  if (letters == 0 || last(letters) != ' ' || digits != 4) throw CutShort("the text at its end is not whole");
}

std::size_t channel(const IgorWave& wave, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const auto found = std::find(wave.labels.begin(), wave.labels.end(), name);
    if (found != wave.labels.end()) return static_cast<std::size_t>(found - wave.labels.begin());
  }
  throw CurveError(fmt::format("it has no channel {}", fmt::join(names, " or ")));
}

// Calibration in a note; empty for NaN and zero, with which Asylum's program marks a missing calibration.
std::optional<double> calibration_in(std::string_view note, std::string_view key) {
  const auto number = note_number(note, key);
  return number && *number != 0.0 ? number : std::nullopt;
}

}  // namespace

CurveMetadata asylum_metadata(std::string_view note) {
  CurveMetadata metadata;
  if (const auto k = calibration_in(note, "SpringConstant")) metadata.spring_constant = physics::Stiffness(*k);
  metadata.sensitivity_m_per_v = calibration_in(note, "InvOLS");
  if (const auto v = note_number(note, "ApproachVelocity")) metadata.approach_speed = physics::Velocity(*v);
  if (const auto v = note_number(note, "RetractVelocity")) metadata.retract_speed = physics::Velocity(*v);
  if (note_value(note, "TriggerChannel") == "Force") {
    if (const auto force = note_number(note, "TriggerPoint")) metadata.setpoint = physics::Force(*force);
  }
  metadata.instrument = note_value(note, "MicroscopeModel");
  metadata.software = "Asylum Research";
  metadata.software_version = note_value(note, "Version");
  metadata.date = note_value(note, "Date");
  metadata.time = note_value(note, "Time");
  return metadata;
}

namespace {

// Column of the deflection, and newtons per its unit: metres, or volts in a wave without metres. Takes from
// `reading` what the note lacks.
struct DeflectionChannel {
  std::size_t column = 0;
  double newton_per_unit = 0;
};

DeflectionChannel deflection_of(const IgorWave& wave, const CurveReading& reading, CurveMetadata& metadata) {
  constexpr std::string_view kVolts = "DeflV";
  const auto in_volts = std::find_if(wave.labels.begin(), wave.labels.end(),
                                     [&](std::string_view label) { return label.starts_with(kVolts); });
  const auto in_metres = std::find_if(wave.labels.begin(), wave.labels.end(),
                                      [](std::string_view label) { return label == "Defl" || label == "Deflection"; });
  const bool volts = in_metres == wave.labels.end() && in_volts != wave.labels.end();
  if (!metadata.spring_constant) metadata.spring_constant = reading.spring_constant;
  if (volts && !metadata.sensitivity_m_per_v) metadata.sensitivity_m_per_v = reading.sensitivity_m_per_v;
  std::string missing;
  if (!metadata.spring_constant) missing = "no valid SpringConstant; give --spring-constant";
  if (volts && !metadata.sensitivity_m_per_v) {
    missing = missing.empty() ? "no valid InvOLS; give --sensitivity"
                              : "no valid SpringConstant and InvOLS; give --spring-constant and --sensitivity";
  }
  if (!missing.empty()) throw CurveError("its lever is not calibrated: its note has " + missing);
  const double k_n_per_m = metadata.spring_constant->si;
  if (volts) {
    return {static_cast<std::size_t>(in_volts - wave.labels.begin()), k_n_per_m * *metadata.sensitivity_m_per_v};
  }
  return {channel(wave, {"Defl", "Deflection"}), k_n_per_m};
}

// Numbers of "Indexes: 0,199,399"; NaN for anything else among them.
std::vector<double> numbers_in(std::string_view list) {
  std::vector<std::string_view> fields;
  split(list, ',', fields);
  if (!fields.empty() && trimmed(fields.back()).empty()) fields.pop_back();
  std::vector<double> numbers;
  numbers.reserve(fields.size());
  for (const std::string_view field : fields) {
    numbers.push_back(number_of(trimmed(field)).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return numbers;
}

// Section of the curve: the rows up to `end`, and the tip's direction: 1 to the sample, 0 at rest, -1 away from it.
struct Section {
  double direction = 0;
  std::size_t end = 0;
};

// Sections of the note, each from one of its "Indexes" to the next, whose "Direction" is that of the second. Empty if
// there are none or they do not fit the wave.
std::vector<Section> sections_of(const IgorWave& wave) {
  const std::vector<double> indexes = numbers_in(note_value(wave.note, "Indexes"));
  std::vector<double> directions = numbers_in(note_value(wave.note, "Direction"));
  const auto rows = static_cast<double>(wave.rows);
  if (indexes.size() < 3 || !std::is_sorted(indexes.begin(), indexes.end()) || !(indexes.back() < rows + 1.0))
    return {};
  if (directions.size() != indexes.size()) {
    directions = indexes.size() == 3   ? std::vector<double>{0, 1, -1}
                 : indexes.size() == 4 ? std::vector<double>{0, 1, 0, -1}
                                       : std::vector<double>{};
  }
  std::vector<Section> sections;
  for (std::size_t i = 1; i < directions.size(); ++i) {
    if (!std::isfinite(directions[i]) || !(indexes[i] >= 0.0)) return {};
    sections.push_back({directions[i], static_cast<std::size_t>(std::min(rows, std::floor(indexes[i]) + 1.0))});
  }
  const auto goes = [&](double way) {
    return std::any_of(sections.begin(), sections.end(), [&](const Section& s) { return s.direction == way; });
  };
  if (!goes(1.0) || !goes(-1.0)) return {};
  sections.back().end = wave.rows;
  return sections;
}

// Splits a curve without sections at its deepest point, or the highest if the heights count the other way.
void turn_at_deepest(RecordedCurve& curve) {
  const auto [lowest, highest] = std::minmax_element(curve.points.begin(), curve.points.end(),
                                                     [](const auto& a, const auto& b) { return a.z < b.z; });
  const auto from_ends = [&](auto point) {
    return std::min(point - curve.points.begin(), curve.points.end() - 1 - point);
  };
  const auto few = static_cast<std::ptrdiff_t>(curve.points.size() / 20);
  const auto turn = from_ends(lowest) <= few && from_ends(highest) > few ? highest : lowest;
  for (auto point = turn; point != curve.points.end(); ++point) {
    if (point != turn) point->branch = physics::Branch::Retract;
  }
}

// Splits the points, of which point i is in row rows[i], by the sections of the note, without those in which the tip
// rests.
void split_by(const std::vector<Section>& sections, const std::vector<std::size_t>& rows, RecordedCurve& curve) {
  std::vector<physics::CurvePoint> kept;
  std::size_t before = 0, between = 0, after = 0;  // number of points at rest before, between and after the branches
  auto section = sections.begin();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    while (rows[i] >= section->end && section + 1 != sections.end()) ++section;
    if (section->direction == 0.0) {
      ++(kept.empty() ? before : kept.back().branch == physics::Branch::Approach ? between : after);
      continue;
    }
    kept.push_back({curve.points[i].z, curve.points[i].force,
                    section->direction > 0.0 ? physics::Branch::Approach : physics::Branch::Retract});
  }
  curve.points = std::move(kept);
  for (const auto& [points, when] :
       {std::pair(before, kBeforeApproach), std::pair(between, kBetweenBranches), std::pair(after, kAfterRetract)}) {
    if (points > 0) remark_left_out(points, when, "rests", std::nullopt, curve.metadata);
  }
}

}  // namespace

RecordedCurve read_igor(std::string_view bytes, const CurveReading& reading) {
  if (looks_like_igor_image(bytes))
    throw CurveError("its wave is not a table of channels with labels: it is an image or a volume");
  const IgorWave wave = read_igor_wave(bytes);
  check_curve_trailer(wave.trailer);
  if (wave.rows > kMostCurvePoints) throw CurveError("it has more points than a curve may have");
  RecordedCurve curve{{}, {}, asylum_metadata(wave.note)};
  const std::size_t height = channel(wave, {"ZSnsr", "ZSensor", "Raw", "Height"});
  const DeflectionChannel deflection = deflection_of(wave, reading, curve.metadata);
  std::vector<std::size_t> rows;  // row of each point
  for (std::size_t row = 0; row < wave.rows; ++row) {
    const double z = -wave.value(row, height), signal = wave.value(row, deflection.column);
    if (!std::isfinite(z) || !std::isfinite(signal)) continue;
    rows.push_back(row);
    curve.points.push_back({physics::Length(z), physics::Force(deflection.newton_per_unit * signal)});
  }
  if (curve.points.empty()) return curve;
  // some waves are filled up at their end
  if (const std::size_t recorded = rows.back() + 1; rows.size() < recorded) {
    curve.metadata.remarks.push_back(
        fmt::format("{} of its {} points were not recorded: they are left out", recorded - rows.size(), recorded));
  }
  const std::vector<Section> sections = sections_of(wave);
  turn_at_deepest(curve);
  // the note gives the turn of the stage, which the tip's height follows a few points later
  const auto turn = static_cast<std::size_t>(std::count_if(
      curve.points.begin(), curve.points.end(), [](const auto& p) { return p.branch == physics::Branch::Approach; }));
  const auto first_end = sections.empty() ? turn : sections.front().end;
  const bool agrees = std::max(turn, first_end) - std::min(turn, first_end) <= curve.points.size() / 100;
  // the time of a dwell is in the note also where its setting is off
  const double dwell = note_number(wave.note, "DwellTime").value_or(0.0);
  if (sections.empty() && dwell > 0.0 && note_number(wave.note, "DwellSetting").value_or(1.0) > 0.0) {
    curve.metadata.remarks.emplace_back(
        "the tip rested on the sample, but its note does not say where (Indexes): it is split where it is deepest");
  }
  if (!sections.empty() && !(sections.size() == 2 && agrees)) split_by(sections, rows, curve);
  return curve;
}

}  // namespace afm::curves
