// SPDX-License-Identifier: Apache-2.0
// Invariant: every artefact of a scan has its closed form at three rates of the feedback
#include "physics/imaging/scanner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

// A15 to A26 are rows of the table of cases, each at three rates of the feedback.
namespace scan_loop_test {

using namespace afm::physics;

constexpr double kPi = std::numbers::pi;
constexpr double kTau = 1e-3, kSpeed = 10e-6, kSetpointDeflection = 5e-9;

// The loop of the table: lever of 0.1 N/m, 0.5 nN of setpoint and of adhesion, tau of 1 ms, a z scanner that follows at
// once.
ScanSettings table_settings() {
  ScanSettings settings;
  settings.z_resonance = Frequency(0.0);
  settings.friction = 0.0;
  return settings;
}

class LoopOfTheTable : public testing::TestWithParam<double> {
 protected:
  double tick() const { return 1.0 / GetParam(); }
  ScanLoop loop(const ScanSettings& settings) const { return ScanLoop(settings, Time(tick()), 1); }
};

INSTANTIATE_TEST_SUITE_P(Rates, LoopOfTheTable, testing::Values(0.5e6, 1e6, 2e6));

// Component of a channel with the period `period_m`, over the second half of the line: amplitude and lag.
struct Wave {
  double amplitude, lag_m;
};

Wave wave_of(const std::vector<double>& values, double width_m, double period_m) {
  std::complex<double> sum = 0.0;
  const std::size_t count = values.size();
  for (std::size_t i = count / 2; i < count; ++i) {
    const double x_m = ((static_cast<double>(i) + 0.5) / static_cast<double>(count) - 0.5) * width_m;
    sum += values[i] * std::polar(1.0, -2.0 * kPi * x_m / period_m);
  }
  sum *= std::complex<double>(0.0, 4.0 / static_cast<double>(count));  // amplitude of a sine
  return {std::abs(sum), -std::arg(sum) * period_m / (2.0 * kPi)};
}

// Line of 400 nm, half of which is 20 tau: the transient at its beginning has faded.
ScanLine scanned_sine(double loop_rate, double period_m) {
  ScanArea area;
  area.width = Length(400e-9);
  area.columns = 4000;
  area.rows = 1;
  ScanSettings settings = table_settings();
  settings.line_rate = Frequency(kSpeed / (2.0 * area.width.si));
  settings.loop_rate = Frequency(loop_rate);
  Scanner scanner(area, settings, [&](double x, double) { return 5e-9 * std::sin(2.0 * kPi * x / period_m); });
  ScanLine line;
  EXPECT_TRUE(scanner.next_line(line));
  return line;
}

TEST_P(LoopOfTheTable, A15BlursASine) {
  const Wave image = wave_of(scanned_sine(GetParam(), 100e-9).trace.height_m, 400e-9, 100e-9);
  EXPECT_NEAR(image.amplitude / 4.23366508e-09, 1.0, 5e-4);
}

TEST_P(LoopOfTheTable, A16LagsBehindASine) {
  const Wave image = wave_of(scanned_sine(GetParam(), 100e-9).trace.height_m, 400e-9, 100e-9);
  const double w_tau = 2.0 * kPi * kSpeed * kTau / 100e-9;
  EXPECT_NEAR(image.lag_m / (std::atan(w_tau) * 100e-9 / (2.0 * kPi)), 1.0, 1e-3);
}

TEST_P(LoopOfTheTable, A17ShowsTheRestOfASineAsForce) {
  const Wave error = wave_of(scanned_sine(GetParam(), 100e-9).trace.error_n, 400e-9, 100e-9);
  EXPECT_NEAR(error.amplitude / 2.660090223e-10, 1.0, 5e-4);
}

TEST_P(LoopOfTheTable, A18OverloadsAtAStepUp) {
  ScanLoop loop = this->loop(table_settings());
  double peak_n = 0.0, after_tau_n = 0.0;
  const int ticks = static_cast<int>(std::lround(kTau / tick()));
  for (int i = 0; i <= ticks; ++i) {
    loop.tick(20e-9);
    peak_n = std::max(peak_n, loop.force_n());
    after_tau_n = loop.force_n();
  }
  EXPECT_NEAR(peak_n / 2.5e-9, 1.0, 1e-6);
  EXPECT_NEAR((after_tau_n - 0.5e-9) / (2e-9 * std::exp(-1.0)), 1.0, 2e-3) << "it decays with tau";
}

// Time from a step down until contact, in seconds.
double time_off_surface(ScanLoop& loop, double step_m, double tick_s) {
  int ticks = 0;
  loop.tick(-step_m);
  for (; !loop.touching() && ticks < 100'000'000; ++ticks) loop.tick(-step_m);
  return ticks * tick_s;
}

TEST_P(LoopOfTheTable, A19ParachutesBehindAStepDown) {
  ScanLoop loop = this->loop(table_settings());
  EXPECT_NEAR(time_off_surface(loop, 20e-9, tick()) / 0.003, 1.0, 1e-3);
}

TEST_P(LoopOfTheTable, A20DrawsASlopeBehindAStepDown) {
  // the step lies between two pixels of 0.1 nm; the tip is off until the image is level again
  ScanArea area;
  area.width = Length(200e-9);
  area.columns = static_cast<std::size_t>(std::lround(200e-9 / kSpeed * GetParam() / 10.0));
  ASSERT_LE(area.columns, kMostScanPixels);
  area.rows = 1;
  ScanSettings settings = table_settings();
  settings.line_rate = Frequency(kSpeed / (2.0 * area.width.si));
  settings.loop_rate = Frequency(GetParam());
  Scanner scanner(area, settings, [](double x, double) { return x < 0.0 ? 20e-9 : 0.0; });
  double off_m = 0.0;
  while (const auto pixel = scanner.next()) {
    if (pixel->pass == ScanPass::Trace) {
      off_m += pixel->off_surface * area.width.si / static_cast<double>(area.columns);
    }
  }
  EXPECT_NEAR(off_m / 3e-8, 1.0, 1e-3);
}

TEST_P(LoopOfTheTable, A21IsHeldByAdhesionBehindALowerStep) {
  for (const double step_m : {9.999e-9, 10.001e-9}) {
    ScanLoop loop = this->loop(table_settings());
    loop.tick(-step_m);
    EXPECT_EQ(loop.touching(), step_m < 10e-9) << "it leaves at d_set + F_ad/k";
  }
}

TEST_P(LoopOfTheTable, A22HoldsTheTipByItsAdhesion) {
  ScanLoop loop = this->loop(table_settings());
  double lowest_n = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    loop.tick(-9e-9);
    ASSERT_TRUE(loop.touching());
    lowest_n = std::min(lowest_n, loop.force_n());
  }
  EXPECT_NEAR(lowest_n / -4e-10, 1.0, 1e-6);
}

// The swing about the setpoint after a nudge, in the last part of `seconds` over that before it.
double growth(ScanLoop loop, double seconds, double tick_s) {
  double early_m = 0.0, late_m = 0.0;
  const int ticks = static_cast<int>(seconds / tick_s);
  for (int i = 0; i < ticks; ++i) {
    loop.tick(i == 0 ? 1e-12 : 0.0);
    double& largest_m = i < ticks / 2 ? early_m : late_m;
    if (i > ticks / 4) largest_m = std::max(largest_m, std::abs(loop.deflection_m() - kSetpointDeflection));
  }
  return late_m / early_m;
}

TEST_P(LoopOfTheTable, A23RingsAboveTheGainThatTheZResonanceAllows) {
  ScanSettings settings = table_settings();
  settings.z_resonance = Frequency(1e3);
  settings.z_quality_factor = 20.0;
  constexpr double kLimit = 314.1592654;
  EXPECT_NEAR(loop(settings).largest_integral_gain().si / kLimit, 1.0, 1e-3);
  settings.integral_gain = Frequency(kLimit * 0.98);
  EXPECT_LT(growth(loop(settings), 1.0, tick()), 0.99);
  settings.integral_gain = Frequency(kLimit * 1.02);
  EXPECT_GT(growth(loop(settings), 1.0, tick()), 1.01);
}

TEST(ScanLoop, A24IsStableWithinJurysLimits) {
  ScanSettings settings = table_settings();
  settings.proportional_gain = 0.4;
  constexpr double kTick = 1e-5;
  EXPECT_NEAR(ScanLoop(settings, Time(kTick), 1).largest_integral_gain().si * kTick, 1.2, 1e-9);
  settings.integral_gain = Frequency((1.2 - 1e-3) / kTick);
  EXPECT_LT(growth(ScanLoop(settings, Time(kTick), 1), 0.02, kTick), 1.0);
  settings.integral_gain = Frequency((1.2 + 1e-3) / kTick);
  EXPECT_GT(growth(ScanLoop(settings, Time(kTick), 1), 0.02, kTick), 1.0);
  settings.proportional_gain = 1.1;
  EXPECT_EQ(ScanLoop(settings, Time(kTick), 1).largest_integral_gain().si, 0.0) << "|Kp| < 1";
}

TEST(ScanLoop, A25SwingsWithAPeriodOfSixTicksIfTheDetectorIsOneTickLate) {
  ScanSettings settings = table_settings();
  constexpr double kTick = 1e-5;
  settings.detector_delay = Time(kTick);
  settings.integral_gain = Frequency(1.0 / kTick);
  ScanLoop loop(settings, Time(kTick), 1);
  EXPECT_NEAR(loop.largest_integral_gain().si * kTick, 1.0, 1e-9);
  std::vector<double> swing;
  for (int i = 0; i < 600; ++i) {
    loop.tick(i == 0 ? 1e-12 : 0.0);
    swing.push_back(loop.deflection_m() - kSetpointDeflection);
  }
  for (std::size_t i = 500; i + 6 < swing.size(); ++i) {
    EXPECT_NEAR(swing[i + 6], swing[i], 1e-18);
    EXPECT_NEAR(swing[i + 3], -swing[i], 1e-18);
  }
  settings.integral_gain = Frequency(0.98 / kTick);
  EXPECT_LT(growth(ScanLoop(settings, Time(kTick), 1), 0.02, kTick), 1.0);
  settings.integral_gain = Frequency(1.02 / kTick);
  EXPECT_GT(growth(ScanLoop(settings, Time(kTick), 1), 0.002, kTick), 1.0);
}

TEST_P(LoopOfTheTable, A26PutsTheDetectorsNoiseIntoTheHeight) {
  ScanSettings settings = table_settings();
  settings.noise = Length(50e-12);
  ScanLoop loop(settings, Time(tick()), 26);
  double square = 0.0;
  const int ticks = static_cast<int>(8.0 / tick());
  for (int i = 0; i < ticks; ++i) {
    loop.tick(0.0);
    square += loop.topography_m() * loop.topography_m();
  }
  const double density = 50e-12 * 50e-12 / 1e3;
  // 4000 independent stretches of 2 tau: the spread of the rms is 1.1 %
  EXPECT_NEAR(std::sqrt(square / ticks) / std::sqrt(density / (4.0 * kTau)), 1.0, 0.04);
}

}  // namespace scan_loop_test
