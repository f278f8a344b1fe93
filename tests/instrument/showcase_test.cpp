// SPDX-License-Identifier: Apache-2.0
// Invariant: a window that shows the simulated microscope changes none of its results
#include "instrument/showcase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "instrument/simulated_instrument.h"
#include "support/places.h"

namespace afm::instrument {
namespace showcase_test {

SimulatedInstrument noisy() {
  auto instrument = std::move(SimulatedInstrument::create(support::source("assets"), 3)).value();
  InstrumentSettings settings(instrument.settings());
  settings.pixels = 16;
  settings.size_m = 30e-9;
  settings.faults.force_noise_n = 20e-12;
  settings.faults.blunting_force_n = 0.6e-9;
  settings.faults.tip_change = 0.3;
  EXPECT_TRUE(instrument.change(settings));
  return instrument;
}

std::vector<double> results_of(SimulatedInstrument& instrument) {
  std::vector<double> numbers = instrument.curve({.points = 100}).value().shown_n;
  instrument.approach(1e-6);
  const auto image = instrument.scan([](const physics::ScanLine&, double) { return true; }).value();
  for (const auto& channel : image.channels)
    numbers.insert(numbers.end(), channel.values.begin(), channel.values.end());
  numbers.push_back(instrument.truth().tip_radius_m);
  numbers.push_back(instrument.position().time_s);
  return numbers;
}

TEST(Showcase, ChangesNoResult) {
  SimulatedInstrument alone = noisy(), shown = noisy();
  Showcase showcase;
  shown.show_in(showcase);
  EXPECT_EQ(results_of(alone), results_of(shown));
}

TEST(Showcase, HasTheNewestOfEverything) {
  SimulatedInstrument instrument = noisy();
  Showcase showcase;
  instrument.show_in(showcase);
  const Shown first = showcase.look();
  EXPECT_EQ(first.setup->material.name, "mica");
  EXPECT_EQ(first.curve, nullptr);
  EXPECT_GT(first.z_m, 1e-7);
  EXPECT_FALSE(first.touching);

  results_of(instrument);
  const Shown then = showcase.look();
  EXPECT_EQ(then.curves, 1U);
  EXPECT_GE(then.curve->samples.size(), 200U);
  EXPECT_TRUE(then.touching);
  EXPECT_GT(then.force_n, 0.0);
  EXPECT_EQ(then.image.number, 1U);
  EXPECT_EQ(then.lines.size(), 16U);
  EXPECT_FALSE(then.image.running);
  EXPECT_EQ(then.image.curves, 1U) << "taken before it";
  EXPECT_TRUE(showcase.look().lines.empty()) << "they have been taken out";
}

// In tapping mode the error is one of the amplitude, in metres.
TEST(Showcase, ShowsNoAmplitudeAsAForce) {
  SimulatedInstrument instrument = noisy();
  Showcase showcase;
  instrument.show_in(showcase);
  InstrumentSettings settings(instrument.settings());
  settings.taps = true;
  settings.contact.model = "dmt";
  settings.contact.si_values = {{"spring-constant", 40.0}, {"resonance", 300e3}, {"quality-factor", 400.0}};
  const auto changed = instrument.change(settings);
  ASSERT_TRUE(changed) << changed.error().message;
  instrument.approach(1e-6);
  double largest_m = 0.0;
  ASSERT_TRUE(instrument.scan([&](const physics::ScanLine& line, double) {
    for (const double error_m : line.trace.error_n) largest_m = std::max(largest_m, std::abs(error_m));
    return true;
  }));
  EXPECT_GT(largest_m, 0.0);
  const Shown shown = showcase.look();
  EXPECT_EQ(shown.force_n, 0.0);
  ASSERT_EQ(shown.lines.size(), 16U);
  for (const physics::ScanLine& line : shown.lines) {
    EXPECT_EQ(line.trace.error_n, std::vector<double>(16, 0.0));
    EXPECT_EQ(line.retrace.error_n, std::vector<double>(16, 0.0));
  }
}

// A window that lacks the material opens again, and then has the lines that were taken meanwhile.
TEST(Showcase, KeepsTheLinesOfAMaterialThatIsNotShown) {
  SimulatedInstrument instrument = noisy();
  Showcase showcase;
  instrument.show_in(showcase);
  results_of(instrument);
  const Shown other = showcase.look([](const std::string& material) { return material != "mica"; });
  EXPECT_TRUE(other.lines.empty());
  EXPECT_EQ(other.setup->material.name, "mica");
  EXPECT_EQ(showcase.look([](const std::string&) { return true; }).lines.size(), 16U);
}

TEST(Showcase, KeepsTheLinesOfOneImageThoughNobodyLooks) {
  SimulatedInstrument instrument = noisy();
  Showcase showcase;
  instrument.show_in(showcase);
  for (int i = 0; i < 3; ++i) results_of(instrument);
  const Shown shown = showcase.look();
  EXPECT_EQ(shown.lines.size(), 16U);
  EXPECT_EQ(shown.image.number, 3U);
  EXPECT_EQ(shown.curves, 3U);
}

}  // namespace showcase_test
}  // namespace afm::instrument
