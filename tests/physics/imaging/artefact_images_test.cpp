// SPDX-License-Identifier: Apache-2.0
// Invariant: in an image, too, every artefact of a scan comes and goes with its cause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "physics/imaging/scanner.h"

// Every artefact where a person sees it: in the numbers of the image, with its closed form; and gone from the image of
// the same sample when its setting is.
namespace artefact_images_test {

using namespace afm::physics;

constexpr std::size_t kColumns = 128, kRow = 2;
constexpr double kWidthM = 512e-9, kPixelM = kWidthM / kColumns;
constexpr double kStepM = 20e-9;

// Lever of 0.1 N/m, 5 nm of setpoint; a slow scan.
ScanSettings good() {
  ScanSettings settings;
  settings.line_rate = Frequency(0.5);
  settings.integral_gain = Frequency(1000.0);
  return settings;
}

ScanImage image_with(const ScanSettings& settings, const Scanner::Surface& surface, std::size_t rows = kRow + 1) {
  ScanArea area;
  area.width = area.height = Length(kWidthM);
  area.columns = kColumns;
  area.rows = rows;
  Scanner scanner(area, settings, surface);
  return scan_frame(scanner);
}

enum Channel : std::size_t { kHeight, kHeightBack, kError };

double at(const ScanImage& image, Channel channel, std::size_t column, std::size_t row = kRow) {
  return image.channels[channel].values[row * kColumns + column];
}

double x_m(std::size_t column) { return (static_cast<double>(column) + 0.5) * kPixelM - 0.5 * kWidthM; }

// The first column of a row whose height is on the other side of a level than the left end's.
std::size_t edge(const ScanImage& image, Channel channel, double level_m, std::size_t row = kRow) {
  const bool high = at(image, channel, 0, row) > level_m;
  std::size_t column = 0;
  while (column < kColumns && (at(image, channel, column, row) > level_m) == high) ++column;
  return column;
}

TEST(ImageOfASine, IsFlatAndLateUnderASlowFeedbackAndTrueUnderAFastOne) {
  constexpr double kA = 5e-9, kWave = 2.0 * std::numbers::pi / 128e-9;
  const auto surface = [](double x, double) { return kA * std::sin(kWave * x); };
  // amplitude and phase of a row, without the first of its four periods, in which the tip has just turned
  const auto wave = [](const ScanImage& image, Channel channel) {
    constexpr std::size_t kPeriod = kColumns / 4, kUsed = 3 * kPeriod;
    const std::size_t first = channel == kHeight ? kPeriod : 0;
    std::complex<double> sum;
    for (std::size_t i = first; i < first + kUsed; ++i) {
      sum += at(image, channel, i) * std::polar(1.0, -kWave * x_m(i)) * (2.0 / static_cast<double>(kUsed));
    }
    return sum * std::complex<double>(0.0, 1.0);  // a for a sin(kx)
  };
  for (const double gain : {1000.0, 25.0}) {
    ScanSettings settings = good();
    settings.integral_gain = Frequency(gain);
    const double w_tau = kWave * 2.0 * kWidthM * settings.line_rate.si / gain;
    const ScanImage image = image_with(settings, surface);
    for (const Channel channel : {kHeight, kHeightBack}) {
      EXPECT_NEAR(std::abs(wave(image, channel)), kA / std::hypot(1.0, w_tau), 0.01 * kA) << gain;
      const double late = channel == kHeight ? -std::arg(wave(image, channel)) : std::arg(wave(image, channel));
      EXPECT_NEAR(late, std::atan(w_tau), 0.02) << gain;
    }
    const double apart_px = 2.0 * std::atan(w_tau) / kWave / kPixelM;
    EXPECT_EQ(apart_px > 5.0, gain < 100.0) << "trace and retrace lie apart in the blurred image alone";
  }
}

TEST(ImageOfAStepUp, ShowsTheOverloadThatAFastScanMakesAndASlowOneDoesNot) {
  const auto surface = [](double x, double) { return std::clamp(x, 0.0, kStepM); };  // 45 degrees
  for (const double rate_hz : {0.5, 30.0}) {
    ScanSettings settings = good();
    settings.line_rate = Frequency(rate_hz);
    const ScanImage image = image_with(settings, surface);
    const double rise_m_per_s = 2.0 * kWidthM * rate_hz, tau_s = 1.0 / settings.integral_gain.si;
    const double most_n =
        settings.spring_constant.si * rise_m_per_s * tau_s * (1.0 - std::exp(-kStepM / (rise_m_per_s * tau_s)));
    double brightest_n = -1.0;
    for (std::size_t i = 0; i < kColumns; ++i) brightest_n = std::max(brightest_n, at(image, kError, i));
    // the middle of a pixel may lie beside the peak
    EXPECT_NEAR(brightest_n, most_n, 0.15 * most_n) << rate_hz;
    EXPECT_EQ(brightest_n > settings.setpoint.si, rate_hz > 1.0) << rate_hz;
  }
}

TEST(ImageOfAStepDown, HasAFalseSlopeWhereTheTipFliesAndNoneUnderAHigherSetpoint) {
  const auto surface = [](double x, double) { return x < 0.0 ? kStepM : 0.0; };
  ScanSettings settings = good();
  settings.line_rate = Frequency(10.0);
  const double pixel_s = 1.0 / (2.0 * kColumns * settings.line_rate.si), tau_s = 1.0 / settings.integral_gain.si;
  // pixels without any force on the lever
  const auto flown = [&](const ScanImage& image, double setpoint_n) {
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < kColumns; ++i) {
      if (at(image, kError, i) < -0.999 * setpoint_n) columns.push_back(i);
    }
    return columns;
  };
  const ScanImage parachuted = image_with(settings, surface);
  const double sunk_m = settings.setpoint.si / settings.spring_constant.si;
  const std::vector<std::size_t> columns = flown(parachuted, settings.setpoint.si);
  EXPECT_NEAR(static_cast<double>(columns.size()), tau_s * (kStepM - sunk_m) / sunk_m / pixel_s, 1.0);
  for (std::size_t i = 1; i < columns.size(); ++i) {
    ASSERT_EQ(columns[i], columns[i - 1] + 1) << "one slope";
    const double slope_m = at(parachuted, kHeight, columns[i - 1]) - at(parachuted, kHeight, columns[i]);
    EXPECT_NEAR(slope_m, sunk_m * pixel_s / tau_s, 0.05 * slope_m) << "false, and straight";
  }
  const auto edge_of = [](const ScanImage& image, Channel channel) {
    return static_cast<double>(edge(image, channel, 0.5 * kStepM));
  };
  EXPECT_NEAR(edge_of(parachuted, kHeightBack), edge_of(image_with(good(), surface), kHeight), 2.0)
      << "on the way back it is a step up, and where it is";

  settings.setpoint = Force(4e-9);
  EXPECT_TRUE(flown(image_with(settings, surface), settings.setpoint.si).empty());
}

TEST(ImageOfAStepUp, RingsAtTheScannersResonanceWithTooMuchGainAlone) {
  const auto surface = [](double x, double) { return x < -0.4 * kWidthM ? 0.0 : 2e-9; };
  ScanSettings settings = good();
  constexpr double kPixelsOfPeriod = 8.0;
  settings.line_rate = Frequency(kPixelsOfPeriod * settings.z_resonance.si / (2.0 * kColumns));
  const auto swings = [&](double share_of_limit) {
    settings.integral_gain =
        Frequency(share_of_limit * 2.0 * std::numbers::pi * settings.z_resonance.si / settings.z_quality_factor);
    const ScanImage image = image_with(settings, surface);
    // behind the step, above and below its level
    constexpr std::size_t kFirst = 64, kCount = 60;
    int crossings = 0;
    double highest_m = 0.0;
    for (std::size_t i = kFirst; i < kFirst + kCount; ++i) {
      const double here_m = at(image, kHeight, i) - 2e-9, next_m = at(image, kHeight, i + 1) - 2e-9;
      if (here_m * next_m < 0.0) ++crossings;
      highest_m = std::max(highest_m, std::abs(here_m));
    }
    return std::pair(crossings, highest_m);
  };
  const auto [crossings, highest_m] = swings(0.95);
  EXPECT_NEAR(crossings, 2.0 * 60.0 / kPixelsOfPeriod, 2.0);
  EXPECT_GT(highest_m, 0.2e-9);
  EXPECT_LE(swings(0.2).first, 1) << "it goes to its level from one side";
}

TEST(ImageOfAVerticalEdge, IsShearedByDriftAndUprightWithout) {
  constexpr std::size_t kRows = 64;
  const auto surface = [](double x, double) { return 3e-9 * std::clamp(x / 20e-9, -1.0, 1.0); };
  for (const double drift_m_per_s : {0.0, 1e-9, -0.5e-9}) {
    ScanSettings settings = good();
    settings.drift_x = Velocity(drift_m_per_s);
    const ScanImage image = image_with(settings, surface, kRows);
    const auto first = static_cast<double>(edge(image, kHeight, 0.0, 0));
    for (std::size_t row = 0; row < kRows; ++row) {
      const double gone_px = drift_m_per_s * static_cast<double>(row) / settings.line_rate.si / kPixelM;
      EXPECT_NEAR(static_cast<double>(edge(image, kHeight, 0.0, row)) - first, gone_px, 1.0) << row;
    }
  }
}

TEST(ImageOfAPeak, HasAGhostOfASecondApexAndNoneWithout) {
  constexpr double kHighM = 10e-9, kApartM = 64e-9, kHigherM = 3e-9;
  const auto surface = [](double x, double) { return kHighM * std::exp(-0.5 * x * x / (10e-9 * 10e-9)); };
  const auto highest = [](const ScanImage& image, double middle_m) {
    double high_m = 0.0;
    for (std::size_t i = 0; i < kColumns; ++i) {
      if (std::abs(x_m(i) - middle_m) < 20e-9) high_m = std::max(high_m, at(image, kHeight, i));
    }
    return high_m;
  };
  ScanSettings settings = good();
  const ScanImage clean = image_with(settings, surface);
  settings.second_apex_distance = Length(kApartM);
  settings.second_apex_height = Length(kHigherM);
  const ScanImage doubled = image_with(settings, surface);
  for (const ScanImage* image : {&clean, &doubled}) EXPECT_NEAR(highest(*image, 0.0), kHighM, 0.5e-9);
  EXPECT_NEAR(highest(doubled, -kApartM), kHighM - kHigherM, 0.5e-9);
  EXPECT_LT(highest(clean, -kApartM), 0.1e-9);
  EXPECT_LT(highest(doubled, kApartM), 0.1e-9);
}

}  // namespace artefact_images_test
