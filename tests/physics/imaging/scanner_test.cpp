// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/scanner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "physics/contact_parameters.h"
#include "support/no_alloc.h"

// A27 to A29, F12 and F15 are rows of the table of cases.
namespace scanner_test {

using namespace afm::physics;

constexpr double kPi = std::numbers::pi;

// The loop of the table: lever of 0.1 N/m, 0.5 nN of setpoint and of adhesion, tau of 1 ms, a z scanner that follows at
// once.
ScanSettings table_settings() {
  ScanSettings settings;
  settings.z_resonance = Frequency(0.0);
  settings.friction = 0.0;
  return settings;
}

TEST(Scanner, A27CoversLessOfASampleThatDriftsAlong) {
  for (const SlowDirection direction : {SlowDirection::Up, SlowDirection::Down}) {
    ScanArea area;
    area.width = area.height = Length(1e-6);
    area.columns = 8;
    ScanSettings settings = table_settings();
    settings.line_rate = Frequency(1.0);
    settings.loop_rate = Frequency(1e3);
    settings.integral_gain = Frequency(100.0);
    settings.drift_y = Velocity(1e-9);
    std::vector<double> asked_m;
    Scanner scanner(area, settings, [&](double, double y) {
      asked_m.push_back(y);
      return 0.0;
    });
    scanner.begin_frame(direction);
    std::vector<double> first_of_line_m;
    while (const auto pixel = scanner.next()) {
      if (pixel->pass == ScanPass::Trace && pixel->column == 0) first_of_line_m.push_back(asked_m.back());
    }
    ASSERT_EQ(first_of_line_m.size(), 256U);
    const double covered_m = std::abs(first_of_line_m.back() - first_of_line_m.front()) * 256.0 / 255.0;
    EXPECT_NEAR(covered_m, direction == SlowDirection::Up ? 7.44e-7 : 1.256e-6, 1e-15);
  }
}

TEST(Scanner, A28ShearsAnEdgeOfASampleThatDriftsAcross) {
  ScanArea area;
  area.width = area.height = Length(1e-6);
  area.columns = 4;
  ScanSettings settings = table_settings();
  settings.line_rate = Frequency(1.0);
  settings.loop_rate = Frequency(1e3);
  settings.integral_gain = Frequency(100.0);
  settings.drift_x = Velocity(1e-9);
  std::vector<double> asked_m;
  Scanner scanner(area, settings, [&](double x, double) {
    asked_m.push_back(x);
    return 0.0;
  });
  std::vector<double> first_of_line_m;
  while (const auto pixel = scanner.next()) {
    if (pixel->pass == ScanPass::Trace && pixel->column == 0) first_of_line_m.push_back(asked_m.back());
  }
  // the scanner's place corresponds to another one of the sample: an edge appears where it is not
  const double shift_m = (first_of_line_m.front() - first_of_line_m.back()) * 256.0 / 255.0;
  EXPECT_NEAR(std::atan(shift_m / area.height.si) * 180.0 / kPi, 14.35933654, 1e-6);
}

TEST(Scanner, A29FeelsASlopeSideways) {
  const double slope = std::tan(10.0 * kPi / 180.0);
  const auto lateral_n = [&](ScanPass pass) { return lateral_force(Force(10e-9), Force(5e-9), slope, 0.3, pass).si; };
  EXPECT_NEAR(lateral_n(ScanPass::Trace) / 6.637521988e-09, 1.0, 1e-9);
  EXPECT_NEAR(lateral_n(ScanPass::Retrace) / -2.621212942e-09, 1.0, 1e-9);
  EXPECT_EQ(lateral_force(Force(-6e-9), Force(5e-9), 0.0, 0.3, ScanPass::Trace).si, 0.0) << "nothing presses";

  ScanArea area;
  area.rows = 2;
  ScanSettings settings = table_settings();
  settings.setpoint = Force(10e-9);
  settings.adhesion = Force(5e-9);
  settings.friction = 0.3;
  settings.line_rate = Frequency(0.01);  // the lag of the loop adds to the force
  settings.integral_gain = Frequency(1e4);
  Scanner scanner(area, settings, [&](double x, double) { return slope * x; });
  ScanLine line;
  ASSERT_TRUE(scanner.next_line(line));
  EXPECT_NEAR(line.trace.lateral_n[128] / 6.637521988e-09, 1.0, 1e-3);
  EXPECT_NEAR(line.retrace.lateral_n[128] / -2.621212942e-09, 1.0, 1e-3);
}

TEST(Scanner, F12MovesAtTwiceTheWidthAndTheLineRate) {
  constexpr double kServoRateHz = 1e3;
  ScanArea area;
  area.width = area.height = Length(1e-6);
  area.columns = 512;
  ScanSettings settings = table_settings();
  settings.line_rate = Frequency(1.0);
  Scanner scanner(area, settings, [](double, double) { return 0.0; });
  EXPECT_NEAR(scanner.pixel_time().si, 0.0009765625, 1e-9 * 0.0009765625);
  EXPECT_NEAR(scanner.pixel_time().si * kServoRateHz, 0.9765625, 1e-9);
  ASSERT_TRUE(scanner.next());
  const double x_m = scanner.x_m(), time_s = scanner.time().si;
  ASSERT_TRUE(scanner.next());
  EXPECT_NEAR((scanner.x_m() - x_m) / (scanner.time().si - time_s), 2e-6, 1e-9 * 2e-6);
}

double bumps(double x, double y) { return 2e-9 * std::sin(x / 20e-9) * std::cos(y / 31e-9); }

TEST(Scanner, ShowsTheSurfaceItselfIfItGoesSlowly) {
  ScanArea area;
  area.width = area.height = Length(100e-9);
  area.x_centre = Length(13e-9);
  area.y_centre = Length(-40e-9);
  area.columns = 24;
  area.rows = 16;
  ScanSettings settings;
  settings.line_rate = Frequency(0.01);
  settings.loop_rate = Frequency(20e3);
  for (const SlowDirection direction : {SlowDirection::Down, SlowDirection::Up}) {
    Scanner scanner(area, settings, bumps);
    scanner.begin_frame(direction);
    const ScanImage image = scan_frame(scanner);
    ASSERT_EQ(image.channels.size(), 6U);
    EXPECT_EQ(image.channels[1].name, "Height (retrace)");
    EXPECT_EQ(image.width_m, 100e-9);
    EXPECT_NEAR(image.x_offset_m, -37e-9, 1e-20);
    EXPECT_NEAR(image.y_offset_m, 10e-9, 1e-20);
    for (std::size_t row = 0; row < area.rows; ++row) {
      for (std::size_t column = 0; column < area.columns; ++column) {
        const double x_m = image.x_offset_m + (static_cast<double>(column) + 0.5) / 24.0 * 100e-9;
        const double y_m = image.y_offset_m - (static_cast<double>(row) + 0.5) / 16.0 * 100e-9;
        for (const std::size_t pass : {0U, 1U}) {
          ASSERT_NEAR(image.channels[pass].values[row * 24 + column], bumps(x_m, y_m), 1e-12);
        }
      }
    }
  }
}

TEST(Scanner, F15ShowsTheGhostOfASecondApex) {
  ScanArea area;
  area.width = Length(200e-9);
  area.columns = 400;
  area.rows = 1;
  ScanSettings settings = table_settings();
  settings.line_rate = Frequency(0.01);
  settings.second_apex_distance = Length(60e-9);
  settings.second_apex_height = Length(3e-9);
  Scanner scanner(area, settings, [](double x, double) { return 10e-9 * std::exp(-x * x / 50e-18); });
  ScanLine line;
  ASSERT_TRUE(scanner.next_line(line));
  const auto& height = line.trace.height_m;
  EXPECT_NEAR(*std::max_element(height.begin(), height.begin() + 120), 7e-9, 0.03e-9);
  EXPECT_NEAR(*std::max_element(height.begin() + 120, height.end()), 10e-9, 0.03e-9);
  EXPECT_GT(line.trace.on_second_apex, 0.05);
  EXPECT_LT(line.trace.on_second_apex, 0.95);
}

TEST(Scanner, TakesTheSameImageFromTheSameSeed) {
  ScanArea area;
  area.columns = area.rows = 16;
  ScanSettings settings;
  settings.noise = Length(50e-12);
  const auto heights = [&](std::uint64_t seed) {
    Scanner scanner(area, settings, bumps, seed);
    return scan_frame(scanner).channels[0].values;
  };
  EXPECT_EQ(heights(5), heights(5));
  EXPECT_NE(heights(5), heights(6));
}

TEST(Scanner, ActsOnAChangeFromTheNextPixelOn) {
  ScanArea area;
  area.columns = 64;
  area.rows = 2;
  Scanner scanner(area, ScanSettings(), bumps);
  for (int i = 0; i < 20; ++i) scanner.next();
  ScanSettings changed;
  changed.feedback = Feedback::Off;
  changed.z_resonance = Frequency(0.0);
  changed.line_rate = Frequency(4.0);
  const double before_s = scanner.time().si;
  scanner.change(changed);
  const double z_m = scanner.next()->height_m;
  EXPECT_NEAR(scanner.time().si - before_s, 1.0 / (2.0 * 64.0 * 4.0), 1e-12);
  for (int i = 0; i < 20; ++i) scanner.next();
  EXPECT_NEAR(scanner.next()->height_m, z_m, 1e-15) << "without feedback the z scanner rests";
  scanner.change_surface([](double, double) { return 1e-9; });
  const auto pixel = scanner.next();
  EXPECT_NEAR(pixel->error_n, 0.1 * (1e-9 - z_m), 1e-15);
}

TEST(Scanner, RefusesWhatNoMicroscopeHasAndKeepsWhatItHad) {
  Scanner scanner(ScanArea(), ScanSettings(), bumps);
  for (const ScanField& field : kScanFields) {
    for (const double si : {field.smallest - 1e-3 - std::abs(field.smallest), field.largest * 1.01 + 1e-3,
                            std::numeric_limits<double>::quiet_NaN()}) {
      ScanSettings settings;
      field.set(settings, si);
      EXPECT_THROW(scanner.change(settings), UnphysicalValue) << field.name;
    }
    ScanSettings settings;
    field.set(settings, field.smallest);
    EXPECT_EQ(field.get(settings), field.smallest);
    EXPECT_NO_THROW(validate(settings)) << field.name;
  }
  EXPECT_EQ(scanner.settings().line_rate, ScanSettings().line_rate);
  ScanArea area;
  area.columns = 1;
  EXPECT_THROW(Scanner(area, ScanSettings(), bumps), UnphysicalValue);
  area.columns = kMostScanPixels + 1;
  EXPECT_THROW(Scanner(area, ScanSettings(), bumps), UnphysicalValue);
}

TEST(Scanner, StaysWithinItsRangeWhateverTheLoopDoes) {
  ScanArea area;
  area.rows = 4;
  ScanSettings settings;
  settings.integral_gain = Frequency(1e6);
  settings.proportional_gain = 10.0;
  settings.z_range = Length(100e-9);
  Scanner scanner(area, settings, bumps);
  while (const auto pixel = scanner.next()) {
    ASSERT_TRUE(std::isfinite(pixel->height_m) && std::isfinite(pixel->error_n) && std::isfinite(pixel->lateral_n));
    ASSERT_LT(std::abs(pixel->height_m), 5e-6);
  }
}

TEST(Scanner, DoesNotAllocateAPixel) {
  ScanSettings settings;
  settings.noise = Length(50e-12);
  Scanner scanner(ScanArea(), settings, bumps);
  ScanLine line;
  ASSERT_TRUE(scanner.next_line(line));
  const afm::test::NoAllocation guard;
  ASSERT_TRUE(scanner.next_line(line));
}

TEST(Scanner, EndsAFrameWhereRequested) {
  Scanner scanner(ScanArea(), ScanSettings(), bumps);
  std::vector<std::size_t> rows;
  const ScanImage image = scan_frame(scanner, [&](const ScanLine& line) {
    rows.push_back(line.row);
    return rows.size() < 3;
  });
  EXPECT_EQ(rows, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(scanner.row(), 3U);
  const std::vector<double>& height = image.channels.front().values;
  EXPECT_FALSE(std::isnan(height[3 * 256 - 1]));
  EXPECT_TRUE(std::isnan(height[3 * 256]));
}

}  // namespace scanner_test
