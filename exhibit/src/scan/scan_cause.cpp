// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_cause.h"

#include <algorithm>
#include <cmath>

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

physics::ScanEvidence evidence_of(const LiveScan& scan) {
  physics::ScanEvidence evidence;
  evidence.relief_m = relief_m(scan);
  evidence.bluntness = scan.choice().tip_radius_m / scan.usual().tip_radius_m;
  const auto newest = scan.newest_row();
  if (!newest) return evidence;
  for (std::size_t i = 0; i < std::min(kJudgedLines, *newest + 1); ++i) {
    const LineFacts& line = scan.facts()[*newest - i];
    evidence.highest_force_n = std::max(evidence.highest_force_n, line.highest_force_n);
    evidence.off_surface = std::max(evidence.off_surface, line.off_surface);
    evidence.on_second_apex = std::max(evidence.on_second_apex, line.on_second_apex);
  }
  return evidence;
}

}  // namespace

physics::ScanArtefact cause_of(const LiveScan& scan) {
  if (scan.is_painted()) return physics::ScanArtefact::None;  // a hand has no lines
  if (scan.progress().frame == 0 && scan.row() < kJudgedLines)
    return physics::ScanArtefact::None;  // too few lines to judge
  const physics::ScanSettings settings = settings_of(scan.choice(), scan.subject().adhesion_n);
  const physics::Scanner& scanner = scan.scanner();
  return main_artefact({settings, scanner.area(), scanner.loop().largest_integral_gain()}, evidence_of(scan));
}

}  // namespace afm::exhibit
