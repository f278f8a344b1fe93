// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/scan_artefact.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace afm::physics {
namespace {

constexpr double kLostShare = 0.95;        // share of a line's time; more means that the tip is not on the sample
constexpr double kSecondApexShare = 0.02;  // share of a line's time
constexpr double kRingingShare = 0.8;      // share of the gain at which the loop oscillates; waves follow each step
constexpr double kDriftShare = 0.03;       // share of a side, during one frame
constexpr double kNoiseShare = 0.03;       // ratio of rms to relief
constexpr double kParachuteShare = 0.004;  // share of a line's time; a shorter flight is invisible
constexpr double kOverloadFactor = 3.0;    // multiple of the setpoint
constexpr double kLagShare = 0.015;        // share of a side; trace and retrace then differ visibly
constexpr double kBluntFactor = 1.5;       // multiple of the sharper tip's radius

bool drifts(const ScanArea& area, const ScanSettings& settings) {
  const double frame_s = static_cast<double>(area.rows) / settings.line_rate.si;
  return std::abs(settings.drift_x.si) * frame_s > kDriftShare * area.width.si ||
         std::abs(settings.drift_y.si) * frame_s > kDriftShare * area.height.si;
}

}  // namespace

std::string_view name_of(ScanArtefact artefact) {
  for (const ScanArtefactName& row : kScanArtefacts) {
    if (row.artefact == artefact) return row.name;
  }
  throw std::logic_error("no such artefact");
}

ScanEvidence evidence_of(const ScanLine& line) {
  ScanEvidence evidence;
  evidence.off_surface = 0.5 * (line.trace.off_surface + line.retrace.off_surface);
  evidence.on_second_apex = 0.5 * (line.trace.on_second_apex + line.retrace.on_second_apex);
  evidence.highest_force_n = std::max(line.trace.highest_force_n, line.retrace.highest_force_n);
  const auto [low, high] = std::minmax_element(line.trace.height_m.begin(), line.trace.height_m.end());
  if (low != high) evidence.relief_m = *high - *low;
  return evidence;
}

void NewestLines::add(const ScanLine& line) {
  newest_[next_] = evidence_of(line);
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
    all.highest_force_n = std::max(all.highest_force_n, line.highest_force_n);
  }
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
  if (follows && settings.integral_gain > kRingingShare * conditions.largest_integral_gain) {
    return ScanArtefact::Ringing;
  }
  if (drifts(conditions.area, settings)) return ScanArtefact::Drift;
  if (noise_of_height(settings).si > kNoiseShare * evidence.relief_m) return ScanArtefact::Noise;
  if (evidence.off_surface > kParachuteShare) return ScanArtefact::Parachuting;
  if (evidence.highest_force_n > kOverloadFactor * std::abs(settings.setpoint.si)) return ScanArtefact::Overload;
  const double lag = 2.0 * settings.line_rate.si / settings.integral_gain.si;
  if (follows && lag > kLagShare) return ScanArtefact::Blur;
  return evidence.bluntness > kBluntFactor ? ScanArtefact::BluntTip : ScanArtefact::None;
}

}  // namespace afm::physics
