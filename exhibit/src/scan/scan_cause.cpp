// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_cause.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace afm::exhibit {

namespace {

using physics::kJudgedLines;

// Range of the measured heights.
double relief_m(const LiveScan& scan) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double height_m : scan.maps().height_m[0]) {
    if (!std::isfinite(height_m)) continue;
    low = std::min(low, height_m);
    high = std::max(high, height_m);
  }
  return std::max(high - low, 0.0);
}

// Time over which drift has added up in the visible image: of whole lines, or of the previous frame.
double seen_s(const LiveScan& scan) {
  if (scan.progress().frame > 0) return static_cast<double>(LiveScan::kPixels) / scan.choice().line_rate_hz;
  const auto pixels_of_line = static_cast<double>(scan.progress().pixel % (2 * LiveScan::kPixels));
  return scan.scanner().time().si - pixels_of_line * scan.scanner().pixel_time().si;
}

// Difference of both passes of a row.
std::vector<double> passes_of(const LiveScan& scan, std::size_t row) {
  const auto line = [&](std::size_t pass) {
    return std::span(scan.maps().height_m[pass]).subspan(row * LiveScan::kPixels, LiveScan::kPixels);
  };
  return physics::difference_of_passes(line(0), line(1));
}

// Changes of state in both passes of a row.
double state_changes_of(const LiveScan& scan, std::size_t row) {
  const physics::TappingDetector* tapping = scan.scanner().loop().tapping();
  if (tapping == nullptr) return 0.0;
  const double free_deg = tapping->lever().free_phase * 180.0 / std::numbers::pi;
  std::size_t changes = 0;
  for (const std::vector<double>& pass : scan.maps().phase_deg) {
    changes += physics::changes_of_state(std::span(pass).subspan(row * LiveScan::kPixels, LiveScan::kPixels), free_deg);
  }
  return static_cast<double>(changes);
}

physics::ScanEvidence evidence_of(const LiveScan& scan) {
  physics::ScanEvidence evidence;
  evidence.relief_m = relief_m(scan);
  evidence.bluntness = scan.choice().tip_radius_m / scan.usual().tip_radius_m;
  const auto newest = scan.newest_row();
  if (!newest) return evidence;
  evidence.time_s = seen_s(scan);
  for (std::size_t i = 0; i < std::min(kJudgedLines, *newest + 1); ++i) {
    const LineFacts& line = scan.facts()[*newest - i];
    evidence.highest_force_n = std::max(evidence.highest_force_n, line.highest_force_n);
    evidence.off_surface = std::max(evidence.off_surface, line.off_surface);
    evidence.on_second_apex = std::max(evidence.on_second_apex, line.on_second_apex);
    evidence.ringing = std::max(evidence.ringing, line.ringing);
    const std::vector<double> passes_m = passes_of(scan, *newest - i);
    evidence.apart_m = std::max(evidence.apart_m, physics::mean_apart_m(passes_m));
    evidence.state_changes = std::max(evidence.state_changes, state_changes_of(scan, *newest - i));
    if (*newest > i) {
      evidence.noise_m =
          std::max(evidence.noise_m, physics::noise_of_lines_m(passes_m, passes_of(scan, *newest - i - 1)));
    }
  }
  return evidence;
}

}  // namespace

physics::ScanArtefact cause_of(const LiveScan& scan) {
  if (scan.is_painted()) return physics::ScanArtefact::None;  // image without lines, painted by a hand
  if (scan.progress().frame == 0 && scan.row() < kJudgedLines)
    return physics::ScanArtefact::None;  // too few lines to judge
  const physics::ScanSettings settings = settings_of(scan.choice(), scan.subject().adhesion_n);
  const physics::Scanner& scanner = scan.scanner();
  return main_artefact({settings, scanner.area(), scanner.loop().largest_integral_gain(), scanner.loop().tapping()},
                       evidence_of(scan));
}

}  // namespace afm::exhibit
