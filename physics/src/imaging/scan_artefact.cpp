// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/scan_artefact.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "physics/imaging/tapping_detector.h"
#include "physics/tapping/driven_lever.h"

namespace afm::physics {
namespace {

constexpr double kLostShare = 0.95;        // share of a line's time; more without contact: the tip is not on the sample
constexpr double kSecondApexShare = 0.02;  // share of a line's time on the second apex
constexpr double kRingingShare = 0.3;      // share of a line's time with ringing; less is the echo of steps
constexpr double kRingingGain = 0.8;       // share of the gain at which the loop oscillates; below it no loop rings
constexpr double kDriftShare = 0.03;       // share of a side by which a sample drifts during one frame
constexpr double kNoiseShare = 0.03;       // ratio of the noise's standard deviation to the relief
constexpr double kOnlyNoise = 10.0;        // ratio of a relief to the noise that alone could make it
constexpr double kParachuteShare = 0.004;  // share of a line's time in flight; a shorter flight is invisible
constexpr double kOverloadFactor = 3.0;    // largest force as a multiple of the setpoint
constexpr double kStoppedShare = 0.9;      // share of the free amplitude that a stopped swing has lost
constexpr double kNeitherDeg = 2.0;        // degrees; phases closer to the free swing's belong to neither state
constexpr std::size_t kSteadyPixels = 4;   // a swing that a step disturbs passes through both states in fewer
constexpr double kLagShare = 0.015;        // share of a side by which trace and retrace are visibly shifted
constexpr double kApartShare = 0.003;      // share of the relief; a smaller difference of both passes is invisible
constexpr double kBluntFactor = 1.5;       // tip radius as a multiple of the sharper tip's

double median_magnitude(std::vector<double> values) {
  if (values.empty()) return 0.0;
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool rings(const ScanConditions& conditions, const ScanEvidence& evidence) {
  const ScanSettings& settings = conditions.settings;
  return settings.feedback == Feedback::On && evidence.ringing > kRingingShare &&
         settings.integral_gain > kRingingGain * conditions.largest_integral_gain;
}

// Returns whether the image is sheared: a feature of the sample has moved by a pixel.
bool drifts(const ScanConditions& conditions, const ScanEvidence& evidence) {
  const ScanArea& area = conditions.area;
  const double frame_s = static_cast<double>(area.rows) / conditions.settings.line_rate.si;
  const auto along = [&](Velocity drift, Length side, std::size_t pixels) {
    const double pixel_m = side.si / static_cast<double>(pixels);
    return std::abs(drift.si) * frame_s > kDriftShare * side.si && std::abs(drift.si) * evidence.time_s > pixel_m;
  };
  return evidence.relief_m > kOnlyNoise * evidence.noise_m &&
         (along(conditions.settings.drift_x, area.width, area.columns) ||
          along(conditions.settings.drift_y, area.height, area.rows));
}

}  // namespace

std::string_view name_of(ScanArtefact artefact) {
  for (const ScanArtefactName& row : kScanArtefacts) {
    if (row.artefact == artefact) return row.name;
  }
  throw std::logic_error("no such artefact");
}

std::vector<double> difference_of_passes(std::span<const double> trace_m, std::span<const double> retrace_m) {
  std::vector<double> passes_m;
  passes_m.reserve(trace_m.size());
  for (std::size_t i = 0; i < trace_m.size(); ++i) passes_m.push_back(trace_m[i] - retrace_m[i]);
  return passes_m;
}

double noise_of_lines_m(std::span<const double> passes_m, std::span<const double> passes_before_m) {
  std::vector<double> changes_m;
  for (std::size_t i = 0; i < std::min(passes_m.size(), passes_before_m.size()); ++i) {
    if (const double change_m = passes_m[i] - passes_before_m[i]; std::isfinite(change_m))
      changes_m.push_back(change_m);
  }
  // four independent heights each; a normal distribution's median absolute deviation
  return 0.5 * 1.4826 * median_magnitude(std::move(changes_m));
}

double mean_apart_m(std::span<const double> passes_m) {
  double sum_m = 0.0;
  for (const double apart_m : passes_m) sum_m += std::isfinite(apart_m) ? std::abs(apart_m) : 0.0;
  return passes_m.empty() ? 0.0 : sum_m / static_cast<double>(passes_m.size());
}

namespace {

ScanEvidence evidence_of(const ScanLine& line, double free_phase_deg) {
  ScanEvidence evidence;
  evidence.off_surface = 0.5 * (line.trace.off_surface + line.retrace.off_surface);
  evidence.on_second_apex = 0.5 * (line.trace.on_second_apex + line.retrace.on_second_apex);
  evidence.ringing = 0.5 * (line.trace.ringing + line.retrace.ringing);
  evidence.highest_force_n = std::max(line.trace.highest_force_n, line.retrace.highest_force_n);
  evidence.state_changes = static_cast<double>(changes_of_state(line.trace.phase_deg, free_phase_deg) +
                                               changes_of_state(line.retrace.phase_deg, free_phase_deg));
  return evidence;
}

}  // namespace

std::size_t changes_of_state(std::span<const double> phase_deg, double free_phase_deg) {
  std::size_t changes = 0, lasts = 0;
  double state = 0.0, candidate = 0.0;  // state of the swing: 1 attractive, -1 repulsive, 0 neither
  for (const double phase : phase_deg) {
    const double from_free_deg = phase - free_phase_deg;
    const double here = std::abs(from_free_deg) > kNeitherDeg ? std::copysign(1.0, from_free_deg) : 0.0;
    lasts = here == candidate ? lasts + 1 : 1;
    candidate = here;
    if (here == 0.0 || here == state || lasts < kSteadyPixels) continue;
    if (state != 0.0) ++changes;
    state = here;
  }
  return changes;
}

NewestLines::NewestLines(const TappingDetector* tapping)
    : free_phase_deg_(tapping == nullptr ? 90.0 : tapping->lever().free_phase * 180.0 / std::numbers::pi) {}

void NewestLines::add(const ScanLine& line, double time_s) {
  std::vector<double> passes_m = difference_of_passes(line.trace.height_m, line.retrace.height_m);
  newest_[next_] = evidence_of(line, free_phase_deg_);
  newest_[next_].apart_m = mean_apart_m(passes_m);
  newest_[next_].noise_m = noise_of_lines_m(passes_m, passes_m_);
  passes_m_ = std::move(passes_m);
  time_s_ = time_s;
  next_ = (next_ + 1) % kJudgedLines;
  const auto [low, high] = std::minmax_element(line.trace.height_m.begin(), line.trace.height_m.end());
  if (low == line.trace.height_m.end()) return;
  low_m_ = std::min(low_m_, *low);
  high_m_ = std::max(high_m_, *high);
}

ScanEvidence NewestLines::evidence() const {
  ScanEvidence all;
  for (const ScanEvidence& line : newest_) {
    all.off_surface = std::max(all.off_surface, line.off_surface);
    all.on_second_apex = std::max(all.on_second_apex, line.on_second_apex);
    all.ringing = std::max(all.ringing, line.ringing);
    all.highest_force_n = std::max(all.highest_force_n, line.highest_force_n);
    all.state_changes = std::max(all.state_changes, line.state_changes);
    all.noise_m = std::max(all.noise_m, line.noise_m);
    all.apart_m = std::max(all.apart_m, line.apart_m);
  }
  all.time_s = time_s_;
  all.relief_m = std::max(high_m_ - low_m_, 0.0);
  return all;
}

ScanArtefact main_artefact(const ScanConditions& conditions, const ScanEvidence& evidence) {
  const ScanSettings& settings = conditions.settings;
  const bool follows = settings.feedback == Feedback::On;
  if (evidence.off_surface > kLostShare) return ScanArtefact::LostContact;
  if (settings.second_apex_distance.si > 0.0 && evidence.on_second_apex > kSecondApexShare) {
    return ScanArtefact::DoubleTip;
  }
  if (rings(conditions, evidence)) return ScanArtefact::Ringing;
  if (drifts(conditions, evidence)) return ScanArtefact::Drift;
  if (settings.noise.si > 0.0 && evidence.noise_m > kNoiseShare * evidence.relief_m) return ScanArtefact::Noise;
  if (evidence.off_surface > kParachuteShare) return ScanArtefact::Parachuting;
  if (conditions.tapping != nullptr) {
    if (evidence.highest_force_n > kStoppedShare * conditions.tapping->free_amplitude_m()) {
      return ScanArtefact::Saturation;
    }
    if (evidence.state_changes > 0.0) return ScanArtefact::StateFlips;
  } else if (evidence.highest_force_n > kOverloadFactor * std::abs(settings.setpoint.si)) {
    return ScanArtefact::Overload;
  }
  const double lag = 2.0 * settings.line_rate.si / settings.integral_gain.si;
  if (follows && lag > kLagShare && evidence.apart_m > kApartShare * evidence.relief_m) return ScanArtefact::Blur;
  return evidence.bluntness > kBluntFactor ? ScanArtefact::BluntTip : ScanArtefact::None;
}

}  // namespace afm::physics
