// SPDX-License-Identifier: Apache-2.0
#include "formats/nanoscope_swing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>

#include "bytes/scaled_unit.h"
#include "bytes/text_table.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr double kMostSwingM = 1e-4, kMostSyncPoints = 1e6;

// Text of a key in any block; null if none has it.
const std::string_view* swing_text(const std::vector<NanoscopeBlock>& blocks, const std::string& key) {
  for (const NanoscopeBlock& block : blocks) {
    if (const std::string_view* text = block.find(key); text != nullptr) return text;
  }
  return nullptr;
}

// Number within limits from the header of a capture; `unit` gets the text after it.
double swing_number(const std::string_view* text, const char* key, double least, double most, std::string_view& unit) {
  if (text == nullptr) throw CurveError(fmt::format("it is a PeakForce capture without \"{}\"", key));
  unit = *text;
  const auto number = take_number(unit);
  if (!number || !(*number >= least && *number <= most)) {
    throw CurveError(fmt::format("the \"{}\" of its PeakForce capture is \"{}\"", key, text->substr(0, 40)));
  }
  return *number;
}

}  // namespace

std::size_t NanoscopeSwing::first() const {
  return (static_cast<std::size_t>(std::floor(turn)) + 1 + points / 2) % points;
}

std::vector<double> NanoscopeSwing::heights_m() const {
  const double half = 0.5 * static_cast<double>(points), begin = std::floor(turn) + 1.0 - half - turn;
  std::vector<double> heights;
  heights.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    const double since_turn = begin + static_cast<double>(i);
    heights.push_back(amplitude_m * (1.0 - std::cos(std::numbers::pi * since_turn / half)));
  }
  return heights;
}

bool is_peakforce_capture(const std::vector<NanoscopeBlock>& blocks) {
  const std::string_view* text = swing_text(blocks, "peakforce capture");
  return text != nullptr && lower_key(trimmed(*text)) == "allow";
}

SensedPeriod sensed_period(const std::vector<double>& heights, const std::vector<double>& deflections) {
  double sum = 0.0, known = 0.0;
  std::optional<std::size_t> pushed;  // point of the largest deflection
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (std::isnan(heights[i])) continue;
    sum += heights[i];
    known += 1.0;
    if (!std::isnan(deflections[i]) && !(pushed && deflections[i] <= deflections[*pushed])) pushed = i;
  }
  if (!pushed) return {};
  const double mean = sum / known;
  SensedPeriod period{.first = 0, .sign = heights[*pushed] > mean ? -1.0 : 1.0};
  const double angle_step = 2.0 * std::numbers::pi / static_cast<double>(heights.size());
  std::complex<double> harmonic;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (std::isnan(heights[i])) continue;
    harmonic -= period.sign * (heights[i] - mean) * std::polar(1.0, angle_step * static_cast<double>(i));
  }
  double turn = std::arg(harmonic) / angle_step;
  if (!std::isfinite(turn)) return period;
  if (turn < 0.0) turn += static_cast<double>(heights.size());
  const NanoscopeSwing swing{.amplitude_m = 0.0, .turn = turn, .points = heights.size()};
  const std::size_t first = swing.first();
  if (std::min(first, heights.size() - first) > heights.size() / 50) period.first = first;
  return period;
}

NanoscopeSwing nanoscope_swing(const std::vector<NanoscopeBlock>& blocks, std::size_t points) {
  std::string_view unit;
  const double amplitude =
      swing_number(swing_text(blocks, "peak force amplitude"), "Peak Force Amplitude", 1e-6, 1e9, unit);
  const ScaledUnit scaled = scaled_unit(trimmed(unit));
  const double amplitude_m = trimmed(unit).empty() ? amplitude * 1e-9 : amplitude * scaled.factor;
  const bool is_length = trimmed(unit).empty() || scaled.unit == "m";
  if (!is_length || !(amplitude_m <= kMostSwingM)) {
    throw CurveError(fmt::format("the \"Peak Force Amplitude\" of its PeakForce capture is {:g} {}", amplitude,
                                 trimmed(unit).substr(0, 20)));
  }
  const double in_period =
      swing_number(swing_text(blocks, "sample points"), "Sample Points", 1.0, kMostSyncPoints, unit);
  const std::string_view* sync = swing_text(blocks, "sync distance qnm");
  if (sync == nullptr) sync = swing_text(blocks, "sync distance");
  const double turn = swing_number(sync, "Sync Distance", 0.0, kMostSyncPoints, unit);
  const auto count = static_cast<double>(points);
  return {.amplitude_m = amplitude_m, .turn = std::fmod(turn * count / in_period, count), .points = points};
}

}  // namespace afm::curves
