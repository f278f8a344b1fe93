// SPDX-License-Identifier: Apache-2.0
// Invariant: the same seed and the same calls give the same results of the simulated microscope, bit for bit
#include "instrument/simulated_instrument.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "fits/thermal_fit.h"
#include "support/places.h"

namespace afm::instrument {
namespace simulated_instrument_test {

using testing::HasSubstr;

SimulatedInstrument instrument_with(std::uint64_t seed = 1) {
  return std::move(SimulatedInstrument::create(support::source("assets"), seed)).value();
}

void set(SimulatedInstrument& instrument, const std::function<void(InstrumentSettings&)>& edit) {
  InstrumentSettings settings(instrument.settings());
  edit(settings);
  const auto changed = instrument.change(settings);
  ASSERT_TRUE(changed) << changed.error().message;
}

std::vector<double> heights_of(SimulatedInstrument& instrument, std::size_t lines) {
  set(instrument, [lines](InstrumentSettings& settings) { settings.lines = lines; });
  auto image = instrument.scan([](const physics::ScanLine&, double) { return true; });
  return image.value().channels.front().values;
}

TEST(SimulatedInstrument, ShowsTheForceOfTheCurveThatTouchafmComputes) {
  SimulatedInstrument instrument = instrument_with();
  const auto curve = instrument.curve({.z_from_m = 20e-9, .z_to_m = -5e-9, .points = 251}).value();
  const auto plain = curves::run_curve(instrument.setup(), {.from = "20nm", .to = "-5nm", .step = "0.1nm"}).value();
  ASSERT_EQ(curve.shown_n.size(), plain.curve.samples.size());
  for (std::size_t i = 0; i < curve.shown_n.size(); ++i) {
    EXPECT_NEAR(curve.shown_n[i], plain.curve.samples[i].force.si, 1e-15) << i;
  }
}

TEST(SimulatedInstrument, F06TakesTheTimeOfAForceVolume) {
  constexpr double kServoRateHz = 1e3;
  SimulatedInstrument instrument = instrument_with();
  const double begin_s = instrument.position().time_s;
  const SimulatedInstrument::CurveRequest request{
      .z_from_m = 180e-9, .z_to_m = -20e-9, .points = 3, .speed_m_per_s = 1e-6};
  ASSERT_TRUE(instrument.curve(request));
  EXPECT_NEAR((instrument.position().time_s - begin_s) * kServoRateHz, 400.0, 1e-9 * 400.0) << "samples of a servo";
  for (int curve = 1; curve < 32 * 32; ++curve) ASSERT_TRUE(instrument.curve(request));
  EXPECT_NEAR(instrument.position().time_s - begin_s, 409.6, 1e-9 * 409.6);
}

TEST(SimulatedInstrument, HasTheNumberOfPointsThatWasAskedFor) {
  SimulatedInstrument instrument = instrument_with();
  for (const std::size_t points : {2U, 7U, 500U, 1024U}) {
    const auto curve = instrument.curve({.points = points}).value();
    const auto& samples = curve.run.curve.samples;
    const auto approach = std::count_if(samples.begin(), samples.end(), [](const physics::CurveSample& sample) {
      return sample.branch == physics::Branch::Approach;
    });
    EXPECT_EQ(static_cast<std::size_t>(approach), points + 2) << "with the two of the jump";
  }
}

TEST(SimulatedInstrument, TakesTheSameTimeAsARealOne) {
  SimulatedInstrument instrument = instrument_with();
  ASSERT_TRUE(instrument.curve({.z_from_m = 100e-9, .z_to_m = -100e-9, .points = 50, .speed_m_per_s = 1e-7}));
  EXPECT_NEAR(instrument.position().time_s, 4.0, 1e-9);
  instrument.wait(2.5);
  EXPECT_NEAR(instrument.position().time_s, 6.5, 1e-9);
}

TEST(SimulatedInstrument, DetectorHasNoiseAndARange) {
  SimulatedInstrument instrument = instrument_with();
  set(instrument, [](InstrumentSettings& settings) { settings.faults.force_noise_n = 20e-12; });
  const auto noisy = instrument.curve({.z_from_m = 30e-9, .z_to_m = 20e-9, .points = 5000}).value();
  double square = 0.0;
  for (std::size_t i = 0; i < noisy.shown_n.size(); ++i) {
    square += std::pow(noisy.shown_n[i] - noisy.run.curve.samples[i].force.si, 2);
  }
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(noisy.shown_n.size())), 20e-12, 1e-12);

  set(instrument, [](InstrumentSettings& settings) { settings.faults.detector_range_n = 0.5e-9; });
  const auto cut = instrument.curve({}).value();
  EXPECT_EQ(*std::min_element(cut.shown_n.begin(), cut.shown_n.end()), -0.5e-9);
  EXPECT_LT(cut.run.figures.force_before_joc.si, -1e-9) << "which the detector does not show";
}

TEST(SimulatedInstrument, ImagesTheSampleThatItSaysIsTrue) {
  SimulatedInstrument instrument = instrument_with();
  set(instrument, [](InstrumentSettings& settings) {
    settings.pixels = 16;
    settings.size_m = 20e-9;
    settings.scan.line_rate = physics::Frequency(0.5);
    settings.scan.noise = physics::Length();
  });
  instrument.approach(1e-6);
  EXPECT_TRUE(instrument.truth().touching);
  auto image = instrument.scan([](const physics::ScanLine&, double) { return true; }).value();
  for (const auto& [column, row] : {std::pair<std::size_t, std::size_t>{3, 5}, {12, 2}, {8, 15}}) {
    const double x_m = image.x_offset_m + (static_cast<double>(column) + 0.5) * image.width_m / 16.0,
                 y_m = image.y_offset_m - (static_cast<double>(row) + 0.5) * image.height_m / 16.0;
    instrument.move_to(x_m, y_m, 1e-6);
    EXPECT_NEAR(image.channels.front().values[row * 16 + column], instrument.truth().surface_m, 20e-12);
  }
}

TEST(SimulatedInstrument, DoesNotScanBeforeTheApproach) {
  SimulatedInstrument instrument = instrument_with();
  const auto image = instrument.scan([](const physics::ScanLine&, double) { return true; });
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().message, HasSubstr("approach"));
}

TEST(SimulatedInstrument, AFalseEngagementShowsALevelSampleAndItsTruthSaysSo) {
  SimulatedInstrument instrument = instrument_with();
  set(instrument, [](InstrumentSettings& settings) { settings.faults.false_engagement = 1.0; });
  instrument.approach(1e-6);
  EXPECT_TRUE(instrument.position().engaged);
  EXPECT_FALSE(instrument.truth().touching);
  EXPECT_GT(instrument.position().z_m, instrument.truth().surface_m);
  const std::vector<double> heights = heights_of(instrument, 8);
  const auto [least, most] = std::minmax_element(heights.begin(), heights.end());
  EXPECT_LT(*most - *least, 1e-12);
}

TEST(SimulatedInstrument, ATipWearsByTheForceBeyondItsLimit) {
  SimulatedInstrument instrument = instrument_with();
  const double sharp_m = instrument.truth().tip_radius_m;
  set(instrument, [](InstrumentSettings& settings) {
    settings.faults.blunting_force_n = 1e-9;
    settings.faults.blunting_m_per_n = 2.0;
  });
  ASSERT_TRUE(instrument.curve({.z_from_m = 50e-9, .z_to_m = -50e-9, .points = 400}));
  const auto truth = instrument.truth();
  EXPECT_GT(truth.highest_force_n, 1e-9);
  EXPECT_NEAR(truth.tip_growth_m, 2.0 * (truth.highest_force_n - 1e-9), 1e-15);
  EXPECT_NEAR(truth.tip_radius_m, sharp_m + truth.tip_growth_m, 1e-15);
  EXPECT_EQ(instrument.setup().material.contact.tip_radius.si, truth.tip_radius_m);
}

// No law has a tip as wide as a metre.
TEST(SimulatedInstrument, NothingHasHappenedIfATipWouldWearTooMuch) {
  SimulatedInstrument instrument = instrument_with(3), other = instrument_with(3);
  for (SimulatedInstrument* each : {&instrument, &other}) {
    set(*each, [](InstrumentSettings& settings) {
      settings.pixels = 8;
      settings.scan.noise = physics::Length(50e-12);
      settings.faults.force_noise_n = 10e-12;
      settings.faults.blunting_m_per_n = 1e9;
    });
    each->approach(1e-6);
  }
  const auto blunts_above = [&](double force_n) {
    set(instrument, [&](InstrumentSettings& settings) { settings.faults.blunting_force_n = force_n; });
  };
  blunts_above(1e-12);
  const auto curve = instrument.curve({});
  ASSERT_FALSE(curve);
  EXPECT_THAT(curve.error().message, HasSubstr("the tip would wear too much"));
  std::size_t lines = 0;
  const auto image = instrument.scan([&](const physics::ScanLine&, double) { return ++lines > 0; });
  ASSERT_FALSE(image);
  EXPECT_EQ(lines, 0U);
  EXPECT_EQ(instrument.position().time_s, other.position().time_s);
  EXPECT_EQ(instrument.truth().tip_radius_m, other.truth().tip_radius_m);
  EXPECT_EQ(instrument.truth().highest_force_n, other.truth().highest_force_n);
  blunts_above(0.0);
  EXPECT_EQ(instrument.curve({}).value().shown_n, other.curve({}).value().shown_n) << "the same noise";
  EXPECT_EQ(heights_of(instrument, 8), heights_of(other, 8)) << "the same chance";
}

TEST(SimulatedInstrument, AChangedTipShowsASecondApex) {
  SimulatedInstrument instrument = instrument_with();
  set(instrument, [](InstrumentSettings& settings) {
    settings.lines = 4;
    settings.faults.tip_change = 1.0;
  });
  instrument.approach(1e-6);
  std::vector<bool> changed;
  ASSERT_TRUE(instrument.scan([&](const physics::ScanLine&, double) {
    changed.push_back(instrument.truth().second_apex);
    return true;
  }));
  EXPECT_THAT(changed, testing::ElementsAre(true, false, true, false));
}

TEST(SimulatedInstrument, AnImageIsTurnedAboutItsMiddle) {
  SimulatedInstrument instrument = instrument_with();
  set(instrument, [](InstrumentSettings& settings) {
    settings.pixels = 9;
    settings.size_m = 18e-9;
    settings.scan.line_rate = physics::Frequency(0.2);
  });
  instrument.approach(1e-6);
  const std::vector<double> straight = heights_of(instrument, 9);
  set(instrument, [](InstrumentSettings& settings) { settings.turn_rad = 0.5 * std::numbers::pi; });
  const std::vector<double> turned = heights_of(instrument, 9);
  // a quarter of a turn: the row from the left becomes the column from the bottom
  for (std::size_t row = 0; row < 9; ++row) {
    for (std::size_t column = 0; column < 9; ++column) {
      EXPECT_NEAR(turned[row * 9 + column], straight[(8 - column) * 9 + 8 - (8 - row)], 20e-12)
          << row << ", " << column;
    }
  }
}

TEST(SimulatedInstrument, AFlatSampleIsFlat) {
  SimulatedInstrument instrument = instrument_with();
  set(instrument, [](InstrumentSettings& settings) { settings.flat = true; });
  instrument.approach(1e-6);
  for (const double height_m : heights_of(instrument, 8)) EXPECT_NEAR(height_m, 0.0, 1e-13);
}

TEST(SimulatedInstrument, ASampleThatDriftsIsElsewhereLater) {
  SimulatedInstrument instrument = instrument_with();
  const double here_m = instrument.truth().surface_m;
  set(instrument, [](InstrumentSettings& settings) { settings.scan.drift_x = physics::Velocity(1e-9); });
  instrument.wait(7.0);
  EXPECT_NEAR(instrument.truth().sample_x_m, 7e-9, 1e-18);
  instrument.move_to(7e-9, 0.0, 1.0);
  EXPECT_NEAR(instrument.truth().surface_m, here_m, 1e-12);
}

TEST(SimulatedInstrument, ThermalNoiseCalibratesItsLever) {
  SimulatedInstrument instrument = instrument_with(3);
  const auto spectrum = instrument.thermal(2000, 2.0 * instrument.setup().material.lever.resonance.si, 200);
  std::string why;
  const auto fit = fits::fit_thermal(spectrum, 200.0, why);
  ASSERT_TRUE(fit) << why;
  const double kt_j = 1.380649e-23 * instrument.setup().material.lever.temperature.si;
  const double k = 0.8174 * kt_j / fit->oscillator.area;  // Butt & Jaschke 1995, as docs/lever.md
  EXPECT_NEAR(k, instrument.setup().material.contact.spring_constant.si, 0.03 * k);
}

// Gold under a tip with two states at this setpoint, as in touchafm scan --mode tapping.
void tap(InstrumentSettings& settings) {
  settings.taps = true;
  settings.amplitude_setpoint = 0.85;
  settings.contact.material = "gold";
  settings.contact.model = "dmt";
  settings.contact.si_values = {{"spring-constant", 40.0},    {"tip-radius", 20e-9},      {"hamaker", 64e-21},
                                {"work-of-adhesion", 0.0623}, {"reduced-modulus", 1.5e9}, {"resonance", 300e3},
                                {"quality-factor", 400.0}};
  settings.pixels = 32;
  settings.scan.line_rate = physics::Frequency(1.0);
  settings.scan.integral_gain = physics::Frequency(500.0);
}

TEST(SimulatedInstrument, ImagesByASwingWhoseFlipsItsTruthCounts) {
  SimulatedInstrument instrument = instrument_with();
  set(instrument, tap);
  instrument.approach(1e-6);
  EXPECT_GT(instrument.position().z_m, instrument.truth().surface_m) << "it swings above the sample";
  EXPECT_EQ(instrument.truth().state_flips, 0U);
  double least_deg = 180.0, most_deg = 0.0;
  const auto image = instrument.scan([&](const physics::ScanLine& line, double) {
    const auto [least, most] = std::minmax_element(line.trace.phase_deg.begin(), line.trace.phase_deg.end());
    least_deg = std::min(least_deg, *least);
    most_deg = std::max(most_deg, *most);
    return true;
  });
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_LT(least_deg, 80.0) << "repulsive";
  EXPECT_GT(most_deg, 100.0) << "attractive";
  EXPECT_GT(instrument.truth().state_flips, 0U);
  EXPECT_GT(instrument.truth().highest_force_n, 1e-9) << "at the lowest points of its swing";
  EXPECT_LT(instrument.truth().highest_force_n, 1e-6);
  set(instrument, [](InstrumentSettings& settings) { settings.taps = false; });
  instrument.approach(1e-6);
  ASSERT_TRUE(instrument.scan([](const physics::ScanLine&, double) { return true; }));
  EXPECT_EQ(instrument.truth().state_flips, 0U) << "of the newest image";
}

TEST(SimulatedInstrument, RefusesAnImageByASwingThatItCannotCompute) {
  SimulatedInstrument instrument = instrument_with();
  set(instrument, tap);
  set(instrument, [](InstrumentSettings& settings) { settings.contact.si_values["quality-factor"] = 0.3; });
  instrument.approach(1e-6);
  const double time_s = instrument.position().time_s;
  const auto image = instrument.scan([](const physics::ScanLine&, double) { return true; });
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().message, HasSubstr("quality factor"));
  EXPECT_EQ(instrument.position().time_s, time_s);
}

TEST(SimulatedInstrument, RepeatsItselfForItsSeedAndNoOther) {
  const auto run = [](std::uint64_t seed) {
    SimulatedInstrument instrument = instrument_with(seed);
    set(instrument, [](InstrumentSettings& settings) {
      settings.scan.noise = physics::Length(50e-12);
      settings.faults.force_noise_n = 10e-12;
      settings.pixels = 8;
    });
    std::vector<double> all = instrument.curve({.points = 50}).value().shown_n;
    instrument.approach(1e-6);
    const std::vector<double> heights = heights_of(instrument, 8);
    all.insert(all.end(), heights.begin(), heights.end());
    for (const fits::SpectrumPoint& point : instrument.thermal(30, 1e4, 3)) all.push_back(point.density);
    return all;
  };
  EXPECT_EQ(run(5), run(5));
  EXPECT_NE(run(5), run(6));
  SimulatedInstrument reset = instrument_with(9);
  ASSERT_TRUE(reset.curve({}));
  ASSERT_TRUE(reset.reset(5));
  EXPECT_EQ(reset.position().time_s, 0.0);
}

// A reset removes a worn tip and other settings of the contact.
TEST(SimulatedInstrument, IsAsNewAfterAResetWhateverItHadBefore) {
  const auto image = [](SimulatedInstrument& instrument) {
    instrument.approach(1e-6);
    set(instrument, [](InstrumentSettings& settings) { settings.pixels = 16; });
    return heights_of(instrument, 4);
  };
  SimulatedInstrument fresh = instrument_with(5);
  const std::vector<double> expected = image(fresh);
  for (const bool worn : {false, true}) {
    SimulatedInstrument used = instrument_with(9);
    set(used, [worn](InstrumentSettings& settings) {
      if (worn) settings.faults = {.blunting_force_n = 1e-9, .blunting_m_per_n = 2.0};
      if (!worn) settings.contact.si_values["tip-radius"] = 20e-9;
    });
    ASSERT_TRUE(used.curve({.z_from_m = 50e-9, .z_to_m = -50e-9, .points = 50}));
    EXPECT_EQ(used.truth().tip_growth_m > 0.0, worn);
    EXPECT_NE(image(used), expected) << worn;
    ASSERT_TRUE(used.reset(5));
    EXPECT_EQ(image(used), expected) << worn;
  }
}

TEST(SimulatedInstrument, KeepsItsSettingsWhenAChangeIsRefused) {
  SimulatedInstrument instrument = instrument_with();
  InstrumentSettings settings(instrument.settings());
  settings.contact.model = "no-such-law";
  settings.pixels = 100;
  EXPECT_FALSE(instrument.change(settings));
  EXPECT_EQ(instrument.settings().pixels, InstrumentSettings().pixels);
  EXPECT_TRUE(instrument.curve({}));
}

}  // namespace simulated_instrument_test
}  // namespace afm::instrument
