// SPDX-License-Identifier: Apache-2.0
// Invariant: the cause of each artefact is named in every language; `scan --json` names the same
#include "exhibit/scan/scan_cause.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

#include "core/enumerators.h"

namespace afm::exhibit {
namespace scan_cause_test {

void scan_lines(LiveScan& scan, double lines) {
  constexpr double kFrameS = 1.0 / 60.0;
  for (double t = 0; t < lines / scan.choice().line_rate_hz; t += kFrameS) scan.advance(kFrameS);
}

// Steps up and down whose flanks a tip of 10 nm still reaches.
ScanSubject stepped_wave() {
  ScanSubject subject;
  subject.drawn_m = [](double x_m, double) { return 2e-9 * std::clamp(5.0 * std::sin(x_m / 20e-9), -1.0, 1.0); };
  subject.traced = [drawn = subject.drawn_m](double) { return drawn; };
  subject.tip_radius_m = 10e-9;
  subject.adhesion_n = 2e-9;
  return subject;
}

// Artefact that `touchafm scan --json` finds in the newest line of the same scan.
physics::ScanArtefact artefact_in_json(const LiveScan& scan, double lines) {
  const physics::ScanSettings settings = settings_of(scan.choice(), scan.subject().adhesion_n);
  physics::Scanner scanner(scan.scanner().area(), settings, scan.subject().traced(scan.choice().tip_radius_m));
  physics::ScanLine line;
  physics::NewestLines newest;
  for (double i = 0; i < lines; ++i) {
    scanner.next_line(line);
    newest.add(line, scanner.time().si);
  }
  return main_artefact({settings, scanner.area(), scanner.loop().largest_integral_gain()}, newest.evidence());
}

TEST(ScanArtefacts, AreTheSameOnTheWallAndInJsonWhateverKeysArePressed) {
  constexpr double kLines = 10;
  std::size_t settings = 0;
  std::set<physics::ScanArtefact> seen;
  for (const ScanRow row :
       {ScanRow::Setpoint, ScanRow::Gain, ScanRow::Rate, ScanRow::SecondApex, ScanRow::Drift, ScanRow::Noise}) {
    for (const int direction : {-1, 1}) {
      for (int times = 1; times <= 14; ++times) {
        LiveScan scan(stepped_wave());
        bool changed = false;
        for (int i = 0; i < times; ++i) changed = scan.step(row, direction);
        if (!changed) break;
        ++settings;
        scan_lines(scan, kLines + 0.5);
        EXPECT_EQ(physics::name_of(cause_of(scan)), physics::name_of(artefact_in_json(scan, kLines)))
            << value_text(scan.choice(), row) << " in row " << core::index_of(row);
        seen.insert(cause_of(scan));
      }
    }
  }
  EXPECT_GE(settings, 45U);
  EXPECT_GE(seen.size(), 7U) << "keys that change nothing would agree, too";
}

}  // namespace scan_cause_test
}  // namespace afm::exhibit
