// SPDX-License-Identifier: Apache-2.0
#include "formats/igor_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>

#include "curves/curve_error.h"
#include "formats/igor_wave.h"

namespace afm::curves {

namespace {

// Asylum's program appends a text that ends with its own length and kind, "0292 Force".
void check_curve_trailer(std::string_view trailer) {
  if (trailer.empty()) return;
  std::size_t letters = 0, digits = 0;
  const auto last = [&](std::size_t back) { return back < trailer.size() ? trailer[trailer.size() - 1 - back] : '\0'; };
  while (std::isalpha(static_cast<unsigned char>(last(letters))) != 0) ++letters;
  while (std::isdigit(static_cast<unsigned char>(last(letters + 1 + digits))) != 0) ++digits;
  if (letters == 0 || last(letters) != ' ' || digits != 4)
    throw CurveError("it is cut short: the text at its end is not whole");
}

std::size_t channel(const IgorWave& wave, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const auto found = std::find(wave.labels.begin(), wave.labels.end(), name);
    if (found != wave.labels.end()) return static_cast<std::size_t>(found - wave.labels.begin());
  }
  throw CurveError(fmt::format("it has no channel {}", fmt::join(names, " or ")));
}

CurveMetadata metadata_of(std::string_view note) {
  CurveMetadata metadata;
  if (const auto k = note_number(note, "SpringConstant")) metadata.spring_constant = physics::Stiffness(*k);
  metadata.sensitivity_m_per_v = note_number(note, "InvOLS");
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

}  // namespace

RecordedCurve read_igor(std::string_view bytes) {
  if (looks_like_igor_image(bytes))
    throw CurveError("its wave is no table of channels with labels: it is an image or a volume");
  const IgorWave wave = read_igor_wave(bytes);
  check_curve_trailer(wave.trailer);
  if (wave.rows > kMostCurvePoints) throw CurveError("it has more points than a curve may have");
  RecordedCurve curve{{}, {}, metadata_of(wave.note)};
  if (!curve.metadata.spring_constant) throw CurveError("its note has no SpringConstant");
  const std::size_t height = channel(wave, {"ZSnsr", "ZSensor", "Raw", "Height"});
  const std::size_t deflection = channel(wave, {"Defl", "Deflection"});
  for (std::size_t row = 0; row < wave.rows; ++row) {
    const double z = -wave.value(row, height), bend = wave.value(row, deflection);
    if (!std::isfinite(z) || !std::isfinite(bend)) continue;
    curve.points.push_back({physics::Length(z), *curve.metadata.spring_constant * physics::Length(bend)});
  }
  const auto deepest = std::min_element(curve.points.begin(), curve.points.end(),
                                        [](const auto& a, const auto& b) { return a.z < b.z; });
  for (auto point = deepest; point != curve.points.end(); ++point) {
    if (point != deepest) point->branch = physics::Branch::Retract;
  }
  return curve;
}

}  // namespace afm::curves
