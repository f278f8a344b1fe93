// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "physics/imaging/scan_artefact.h"
#include "physics/imaging/scanner.h"
#include "physics/tapping/tapped_sample.h"
#include "physics/tapping/tapping_oscillator.h"

namespace tapping_scan_test {

using namespace afm::physics;

TappingDetector detector_at(double setpoint_nm, const TappedSample& sample = {}) {
  return {sample.surface(), sample.lever(), Length(setpoint_nm * 1e-9)};
}

// A free lever so fast that its envelope follows at once, over a surface that only repels.
TappingDetector fast_detector(double setpoint_nm) {
  const TappedSample sample{.k = 1.0, .e_gpa = 100.0};
  const DrivenLever lever =
      driven_lever(Stiffness(sample.k), {Frequency(20e6), 100.0, Temperature()}, {Length(20e-9), Frequency(20e6)});
  return {sample.surface(Law::Hertz), lever, Length(setpoint_nm * 1e-9)};
}

ScanSettings ideal(double gain_per_s) {
  ScanSettings settings;
  settings.z_resonance = Frequency();
  settings.integral_gain = Frequency(gain_per_s);
  settings.line_rate = Frequency(1.0);
  return settings;
}

constexpr double kTickS = 10e-6;

// T48, T49, T50
TEST(TappingLoop, HasTheRelaxationOfItsLeverAndAGainWithoutOvershoot) {
  struct Case {
    double f0, q, relaxation_s, gain;
  };
  for (const Case& c :
       {Case{300e3, 400.0, 0.0004244131816, 589.0486225}, Case{75e3, 200.0, 0.0008488263632, 294.5243113},
        Case{30e3, 3.0, 3.183098862e-05, 7853.981634}}) {
    const DrivenLever lever =
        driven_lever(Stiffness(40.0), {Frequency(c.f0), c.q, Temperature()}, {Length(20e-9), Frequency(c.f0)});
    EXPECT_NEAR(lever.relaxation().si / c.relaxation_s, 1.0, 1e-9);
    EXPECT_NEAR(0.25 / lever.relaxation().si / c.gain, 1.0, 1e-9);
  }
}

// Largest excess of the height over a step of 0.5 nm, in nm.
double overshoot_nm(double gain_per_s) {
  const TappedSample hard{.h_zj = 1.0, .e_gpa = 50.0};
  ScanLoop loop(ideal(gain_per_s), Time(kTickS), 1, detector_at(16.0, hard));
  loop.engage(0.0);
  double most_m = 0.0;
  for (int i = 0; i < 5000; ++i) {
    loop.tick(0.5e-9);
    most_m = std::max(most_m, loop.topography_m());
  }
  EXPECT_NEAR(loop.topography_m() * 1e9, 0.5, 0.01);
  return most_m * 1e9 - 0.5;
}

TEST(TappingLoop, OvershootsAStepBeyondThatGain) {
  EXPECT_LT(overshoot_nm(0.8 * 589.0), 0.01);
  EXPECT_GT(overshoot_nm(4.0 * 589.0), 0.05);
}

// T51, T52: behind a step down of 30 nm the error saturates at A0 - A_set.
TEST(TappingLoop, ParachutesBehindAStepDownAsLongAsTheErrorAllows) {
  struct Case {
    double setpoint_nm, flight_s, speed_m_per_s;
  };
  for (const Case& c : {Case{18.0, 0.007, 4e-6}, Case{19.5, 0.0295, 1e-6}}) {
    ScanLoop loop(ideal(2000.0), Time(1e-6), 1, fast_detector(c.setpoint_nm));
    loop.engage(0.0);
    const double before_m = loop.z_m();
    double time_s = 0.0, fastest = 0.0;
    bool flies = false;
    for (; time_s < 0.1; time_s += 1e-6) {
      const double z_m = loop.z_m();
      loop.tick(-30e-9);
      fastest = std::max(fastest, (z_m - loop.z_m()) / 1e-6);
      flies = flies || loop.deflection_m() < 0.001e-9;
      if (flies && loop.deflection_m() > 0.01e-9) break;
    }
    EXPECT_NEAR(time_s / c.flight_s, 1.0, 0.01) << c.setpoint_nm;
    EXPECT_NEAR(fastest / c.speed_m_per_s, 1.0, 0.01) << c.setpoint_nm;
    EXPECT_LT(loop.z_m(), before_m);
  }
}

// T42, T47: both states at one setpoint.
struct HeldState {
  double z_nm, phase_deg;
};
// The height of the base at which the state on this side of 90 degrees has the amplitude.
HeldState held(double setpoint_nm, bool attractive) {
  const TappedSample sample;
  AveragedFlow flow(sample.surface(), sample.lever());
  double low = 14.0, high = 18.8;
  HeldState state{};
  for (int i = 0; i < 40; ++i) {
    const double z = 0.5 * (low + high);
    bool reaches = false;
    for (const RestingTap& tap : flow.resting_at(Length(z * 1e-9))) {
      if (!tap.stable || (degrees_of(tap.state.phase) > 90.0) != attractive) continue;
      state = {z, degrees_of(tap.state.phase)};
      reaches = nm_of(tap.state.amplitude) >= setpoint_nm;
      break;
    }
    (reaches ? high : low) = z;
  }
  return state;
}

TEST(TappingDetector, EngagesInTheStateThatATipFromAboveFindsFirst) {
  const HeldState attractive = held(18.0, true);
  TappingDetector detector = detector_at(18.0);
  EXPECT_NEAR(detector.engaged_gap_m() * 1e9, attractive.z_nm, 0.001);
  EXPECT_NEAR(detector.phase_rad() * 180.0 / std::numbers::pi, attractive.phase_deg, 0.1);
  for (int i = 0; i < 5000; ++i) detector.advance(detector.engaged_gap_m(), 20.0);
  EXPECT_NEAR(detector.amplitude_m() * 1e9, 18.0, 0.02);
}

TEST(TappingDetector, RestsWhereTheAveragedFlowDoes) {
  const TappedSample sample;
  AveragedFlow flow(sample.surface(), sample.lever());
  for (const double z_nm : {17.4149, 16.0, 12.0, 8.0}) {
    TappingDetector detector = detector_at(15.0);
    for (int i = 0; i < 20000; ++i) detector.advance(z_nm * 1e-9, 20.0);
    double least = 1.0, phase_apart = 0.0;
    for (const RestingTap& tap : flow.resting_at(Length(z_nm * 1e-9))) {
      const double apart = std::abs(detector.amplitude_m() / tap.state.amplitude.si - 1.0);
      if (!tap.stable || apart > least) continue;
      least = apart;
      phase_apart = std::abs(degrees_of(detector.phase_rad() - tap.state.phase));
    }
    EXPECT_LT(phase_apart, 0.2) << z_nm;
    EXPECT_LT(least, 0.002) << z_nm;
  }
}

// Share by which the amplitude of direct integration differs from that of the swing which the detector holds.
double off_at_rest(Harmonics harmonics, const TappedSample& sample, double setpoint_nm) {
  DrivenLever lever = sample.lever();
  lever.harmonics = harmonics;
  TappingDetector detector(sample.surface(), lever, Length(setpoint_nm * 1e-9));
  const Length gap(detector.engaged_gap_m());
  for (int i = 0; i < 20000; ++i) detector.advance(gap.si, 20.0);
  TappingOscillator tip(sample.surface(), sample.lever());
  tip.place(gap, {Length(detector.amplitude_m()), detector.phase_rad()});
  (void)tip.settle();
  return tip.settle().state.amplitude.si / detector.amplitude_m() - 1.0;
}

// The harmonics answered as at the resonance; an older session's image still has them so.
TEST(TappingDetector, RestsWhereDirectIntegrationDoesBesideTheResonance) {
  constexpr auto kOfTheDrive = Harmonics::OfTheDrive;
  const TappedSample above{.ratio = 1.06};
  EXPECT_LT(std::abs(off_at_rest(kOfTheDrive, {.ratio = 0.94}, 14.0)), 1e-3);
  EXPECT_LT(std::abs(off_at_rest(kOfTheDrive, above, 14.0)), 1e-3);
  EXPECT_GT(std::abs(off_at_rest(Harmonics::AtResonance, above, 14.0)), 4e-3);
}

// The tables of one drive serve another of the same lever.
TEST(TappingDetector, RestsWhereTheAveragedFlowDoesWithAnotherDrive) {
  for (const TappedSample& changed : {TappedSample{.a0_nm = 24.0}, TappedSample{.a0_nm = 10.0},
                                      TappedSample{.ratio = 1.00125, .a0_nm = 16.0}, TappedSample{.ratio = 0.99875}}) {
    AveragedFlow flow(changed.surface(), changed.lever());
    TappingDetector detector = detector_at(15.0);
    detector.drive(changed.lever(), Length(0.8e-9 * changed.a0_nm));
    EXPECT_DOUBLE_EQ(detector.free_amplitude_m(), 1e-9 * changed.a0_nm);
    const double z_m = 0.7e-9 * changed.a0_nm;
    for (int i = 0; i < 20000; ++i) detector.advance(z_m, 20.0);
    double least = 1.0;
    for (const RestingTap& tap : flow.resting_at(Length(z_m))) {
      if (tap.stable) least = std::min(least, std::abs(detector.amplitude_m() / tap.state.amplitude.si - 1.0));
    }
    EXPECT_LT(least, 0.003) << changed.a0_nm << " nm, ratio " << changed.ratio;
  }
  TappingDetector detector = detector_at(15.0);
  EXPECT_THROW(detector.drive(TappedSample{.a0_nm = 10.0}.lever(), Length(15e-9)), std::invalid_argument);
  EXPECT_DOUBLE_EQ(detector.free_amplitude_m(), 20e-9) << "nothing has changed";
}

// Height of the base for the same swing if the lever were deflected by its mean force alone.
double without_harmonics_nm(const HeldState& state, double setpoint_nm) {
  const TappedSample sample;
  AveragedFlow flow(sample.surface(), sample.lever());
  for (const RestingTap& tap : flow.resting_at(Length(state.z_nm * 1e-9))) {
    if (!tap.stable || std::abs(nm_of(tap.state.amplitude) - setpoint_nm) > 0.001) continue;
    const Force more = tap.averages.shift_at_lowest - tap.averages.mean;
    return state.z_nm + more.si / sample.lever().spring_constant.si * 1e9;
  }
  return std::nan("");
}

// T47, which has no harmonics
TEST(TappingScan, AFlippedStateIsAFalseStepOnFlatGround) {
  struct Row {
    double setpoint_nm, step_nm, turn_deg;
  };
  for (const Row& row : {Row{18.5, 1.5464, 44.66}, Row{18.0, 1.5127, 51.68}, Row{17.0, 1.3573, 63.58}}) {
    const HeldState above = held(row.setpoint_nm, true), below = held(row.setpoint_nm, false);
    EXPECT_NEAR(without_harmonics_nm(above, row.setpoint_nm) - without_harmonics_nm(below, row.setpoint_nm),
                row.step_nm, 0.01 * row.step_nm)
        << row.setpoint_nm;
    EXPECT_NEAR(above.phase_deg - below.phase_deg, row.turn_deg, 0.2) << row.setpoint_nm;
  }
  const HeldState attractive = held(18.0, true), repulsive = held(18.0, false);
  EXPECT_NEAR(repulsive.z_nm - attractive.z_nm, -1.4876, 0.003);
  TappingDetector detector = detector_at(18.0);
  ScanLoop loop(ideal(50.0), Time(kTickS), 1, detector);
  loop.engage(0.0);
  for (int i = 0; i < 5000; ++i) loop.tick(0.0);
  EXPECT_NEAR(loop.topography_m() * 1e9, 0.0, 0.02);
  EXPECT_GT(loop.tapping()->phase_rad(), std::numbers::pi / 2.0);
  // a particle kicks the swing into the other state
  for (int i = 0; i < 500; ++i) loop.tick(3e-9);
  for (int i = 0; i < 50000; ++i) loop.tick(0.0);
  EXPECT_LT(loop.tapping()->phase_rad(), std::numbers::pi / 2.0);
  EXPECT_NEAR(loop.topography_m() * 1e9, repulsive.z_nm - attractive.z_nm, 0.005);
}

// Without loss the phase follows from the amplitude alone, sin(phi) = A/A0 with either sign: two materials at one
// setpoint differ only in the state.
TEST(TappingDetector, HasOnePhaseOverTwoMaterialsWithoutLossInOneState) {
  const double expected_deg = degrees_of(std::asin(16.0 / 20.0));
  for (const TappedSample& material :
       {TappedSample{.e_gpa = 0.5}, TappedSample{.e_gpa = 1.5}, TappedSample{.h_zj = 30.0, .e_gpa = 20.0}}) {
    TappingDetector detector = detector_at(16.0, material);
    for (int i = 0; i < 5000; ++i) detector.advance(detector.engaged_gap_m(), 20.0);
    const double phase_deg = degrees_of(detector.phase_rad());
    EXPECT_NEAR(phase_deg > 90.0 ? 180.0 - phase_deg : phase_deg, expected_deg, 0.1) << material.e_gpa;
  }
  const TappedSample lossy{.eta_w0_mpa = 50.0};
  TappingDetector detector = detector_at(16.0, lossy);
  for (int i = 0; i < 5000; ++i) detector.advance(detector.engaged_gap_m(), 20.0);
  EXPECT_GT(std::abs(degrees_of(std::asin(std::sin(detector.phase_rad()))) - expected_deg), 1.0);
}

// T45
TEST(TappingDetector, NeverReachesAnIslandFromAbove) {
  const TappedSample sample{.a0_nm = 10.0};
  TappingDetector detector = detector_at(4.819, sample);
  EXPECT_NEAR(detector.engaged_gap_m() * 1e9, 5.0, 0.02);
  EXPECT_NEAR(detector.phase_rad() * 180.0 / std::numbers::pi, 151.19, 0.2);
}

TEST(TappingDetector, RefusesASetpointThatNoFeedbackKeeps) {
  EXPECT_THROW(detector_at(20.0), UnphysicalValue);
  EXPECT_THROW(detector_at(0.1), UnphysicalValue);
}

ScanImage image_of(const ScanSettings& settings, const Scanner::Surface& surface) {
  ScanArea area;
  area.columns = 64;
  area.rows = 4;
  Scanner scanner(area, settings, surface, 1, detector_at(16.0, {.h_zj = 1.0}));
  return scan_frame(scanner);
}

TEST(TappingScan, HasChannelsInTheirUnits) {
  const ScanImage image = image_of(ideal(500.0), [](double x, double) { return 2e-9 * std::sin(x / 30e-9); });
  const std::vector<std::pair<const char*, const char*>> expected = {
      {"Height", "m"}, {"Amplitude error", "m"}, {"Phase", "deg"}, {"Energy dissipated", "J"}, {"Peak force", "N"}};
  ASSERT_EQ(image.channels.size(), 2 * expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(image.channels[2 * i].name, expected[i].first);
    EXPECT_EQ(image.channels[2 * i].unit, expected[i].second);
  }
  const auto [low, high] = std::minmax_element(image.channels[0].values.begin(), image.channels[0].values.end());
  EXPECT_NEAR((*high - *low) * 1e9, 4.0, 0.1);
  EXPECT_EQ(image.channels[0].values,
            image_of(ideal(500.0), [](double x, double) { return 2e-9 * std::sin(x / 30e-9); }).channels[0].values);
}

// Judgement of a surface and a sample.
struct JudgedTap {
  double line_rate_hz = 1.0, setpoint_nm = 16.0;
  TappedSample sample{.h_zj = 1.0};
};
ScanArtefact artefact_of(const JudgedTap& tap, const Scanner::Surface& surface) {
  ScanArea area;
  area.columns = 64;
  area.rows = 4;
  ScanSettings settings = ideal(500.0);
  settings.line_rate = Frequency(tap.line_rate_hz);
  Scanner scanner(area, settings, surface, 1, detector_at(tap.setpoint_nm, tap.sample));
  NewestLines newest(scanner.loop().tapping());
  scan_frame(scanner, [&](const ScanLine& line) {
    newest.add(line, scanner.time().si);
    return true;
  });
  return main_artefact({settings, area, scanner.loop().largest_integral_gain(), scanner.loop().tapping()},
                       newest.evidence());
}

double step_m(double x_m, double /*y_m*/) { return x_m < 0.0 ? 10e-9 : 0.0; }

TEST(TappingScan, ParachutesAboveASetpointNearTheFreeSwingAndNotBelowALowerOne) {
  EXPECT_EQ(artefact_of({.line_rate_hz = 1.0, .setpoint_nm = 19.0}, step_m), ScanArtefact::Parachuting);
  EXPECT_EQ(artefact_of({.line_rate_hz = 0.2, .setpoint_nm = 8.0}, step_m), ScanArtefact::None);
}

TEST(TappingScan, SaturatesAtAStepUpUnlessItIsSlow) {
  EXPECT_EQ(artefact_of({.line_rate_hz = 20.0, .setpoint_nm = 8.0}, step_m), ScanArtefact::Saturation);
  EXPECT_EQ(changes_of_state(std::vector<double>{60, 60, 60, 60, 120, 91, 88, 60, 60, 60, 60}, 90.0), 0U)
      << "disturbed";
  EXPECT_EQ(changes_of_state(std::vector<double>{60, 60, 60, 60, 91, 120, 120, 120, 120, 90}, 90.0), 1U);
}

TEST(TappingScan, FlipsItsStateOverAParticleWhereThereAreTwo) {
  const auto particle = [](double x_m, double) { return std::abs(x_m) < 20e-9 ? 3e-9 : 0.0; };
  EXPECT_EQ(artefact_of({.setpoint_nm = 18.0, .sample = {}}, particle), ScanArtefact::StateFlips);
  EXPECT_EQ(artefact_of({.setpoint_nm = 18.0}, particle), ScanArtefact::None) << "without attraction there is one";
}

}  // namespace tapping_scan_test
