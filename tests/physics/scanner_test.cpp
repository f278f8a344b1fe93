// SPDX-License-Identifier: Apache-2.0
#include "physics/scanner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace afm::physics;

constexpr double kPi = std::numbers::pi;

// The loop of the table's rows: ideal z scanner, tau of 1 ms, setpoint of 5 nm on a lever of 0.1 N/m.
ScanSettings settings_of_the_table() {
  ScanSettings settings;
  settings.z_resonance = Frequency(0.0);
  settings.friction = 0.0;
  return settings;
}

// One line as long as `width` at 10 um/s, with as many pixels as the loop has ticks.
struct Run {
  ScanArea area;
  ScanSettings settings = settings_of_the_table();
};

TEST(Probe, Prints) {
  for (double rate : {0.5e6, 1e6, 2e6}) {
    ScanArea area;
    area.width = Length(400e-9);
    area.rows = 3;
    area.columns = 4000;
    ScanSettings s = settings_of_the_table();
    s.line_rate = Frequency(10e-6 / 800e-9);
    s.loop_rate = Frequency(rate);
    Scanner scanner(area, s, [](double x, double) { return 5e-9 * std::sin(2 * kPi * x / 100e-9); });
    ScanLine line;
    scanner.next_line(line);
    scanner.next_line(line);
    double a = 0, b = 0, c = 0, d = 0;
    for (std::size_t i = 2000; i < 4000; ++i) {
      const double x = (static_cast<double>(i) + 0.5) / 4000 * 400e-9 - 200e-9, w = 2 * kPi * x / 100e-9;
      a += line.trace.height_m[i] * std::sin(w) / 1000;
      b += line.trace.height_m[i] * std::cos(w) / 1000;
      c += line.trace.error_n[i] * std::sin(w) / 1000;
      d += line.trace.error_n[i] * std::cos(w) / 1000;
    }
    printf("%g %.9g (%.3g) %.9g (%.3g)\n", rate, std::hypot(a, b), std::hypot(a, b) / 4.23366508e-09 - 1,
           std::hypot(c, d), std::hypot(c, d) / 2.660090223e-10 - 1);
  }
}

}  // namespace
