// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_cause.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace afm::exhibit {

namespace {

using physics::ScanArtefact;

constexpr double kLostShare = 0.95;    // of a line's time off the sample: the tip is not on it at all
constexpr std::size_t kLines = 6;      // that are judged: the newest whole ones
constexpr double kSeenShare = 0.004;   // of a line's time: less is not seen
constexpr double kSecondShare = 0.02;  // likewise, of the second apex
constexpr double kOverload = 3.0;      // times the setpoint
constexpr double kSeenDrift = 0.03;    // of the image's side in one frame
constexpr double kSeenNoise = 0.03;    // of the range of heights, rms
constexpr double kSeenLag = 0.015;     // of the side: by so much trace and retrace are apart
constexpr double kBlunt = 1.5;         // times the usual radius

LineFacts newest_facts(const LiveScan& scan) {
  LineFacts facts;
  const auto newest = scan.newest_row();
  if (!newest) return facts;
  const std::size_t lines = std::min(kLines, *newest + 1);
  for (std::size_t i = 0; i < lines; ++i) {
    const LineFacts& line = scan.facts()[*newest - i];
    facts.highest_force_n = std::max(facts.highest_force_n, line.highest_force_n);
    facts.off_surface = std::max(facts.off_surface, line.off_surface);
    facts.on_second_apex = std::max(facts.on_second_apex, line.on_second_apex);
  }
  return facts;
}

// From the lowest to the highest place that was measured.
double relief_m(const LiveScan& scan) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double height_m : scan.maps().height_m[0]) {
    if (!std::isfinite(height_m)) continue;
    low = std::min(low, height_m);
    high = std::max(high, height_m);
  }
  return std::max(high - low, 0.0);
}

}  // namespace

physics::ScanArtefact cause_of(const LiveScan& scan) {
  if (scan.is_painted()) return ScanArtefact::None;                                  // a hand does not keep to lines
  if (scan.progress().frame == 0 && scan.row() < kLines) return ScanArtefact::None;  // too little to judge
  const ScanChoice& now = scan.choice();
  const physics::ScanSettings settings = settings_of(now, scan.subject().adhesion_n);
  const LineFacts facts = newest_facts(scan);
  if (facts.off_surface > kLostShare) return ScanArtefact::LostContact;
  if (facts.on_second_apex > kSecondShare && now.apex_distance_m > 0.0) return ScanArtefact::DoubleTip;
  // with pure integral control and a resonance the loop is stable below w0/Q
  const double limit_per_s = 2.0 * std::numbers::pi * settings.z_resonance.si / settings.z_quality_factor;
  if (now.gain_per_s > limit_per_s) return ScanArtefact::Ringing;
  const double frame_s = static_cast<double>(LiveScan::kPixels) / now.line_rate_hz;
  if (now.drift_m_per_s * frame_s > kSeenDrift * scan.subject().side_m) return ScanArtefact::Drift;
  // what passes the loop of the detector's white noise: sqrt(S/(4 tau)), S = noise^2/bandwidth
  const double noise_m = now.noise_m * std::sqrt(now.gain_per_s / (4.0 * physics::kNoiseBandwidth.si));
  if (noise_m > kSeenNoise * relief_m(scan)) return ScanArtefact::Noise;
  // noise that is seen lifts the tip, too
  if (facts.off_surface > kSeenShare) return ScanArtefact::Parachuting;
  if (facts.highest_force_n > kOverload * std::abs(now.setpoint_n)) return ScanArtefact::Overload;
  if (2.0 * now.line_rate_hz / now.gain_per_s > kSeenLag) return ScanArtefact::Blur;
  return now.tip_radius_m > kBlunt * scan.usual().tip_radius_m ? ScanArtefact::BluntTip : ScanArtefact::None;
}

}  // namespace afm::exhibit
