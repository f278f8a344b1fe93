// SPDX-License-Identifier: Apache-2.0
// Invariant: a lever's base that a client moves without feedback goes through the law's own cycle, with both jumps
#include "instrument/held_base.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "curves/curve_run.h"
#include "instrument/simulated_instrument.h"
#include "support/places.h"

namespace afm::instrument {
namespace held_base_test {

using testing::HasSubstr;

SimulatedInstrument instrument_with(const std::function<void(InstrumentSettings&)>& edit) {
  auto made = SimulatedInstrument::create(support::source("assets"), 1);
  EXPECT_TRUE(made);
  InstrumentSettings settings(made->settings());
  settings.flat = true;
  edit(settings);
  const auto changed = made->change(settings);
  EXPECT_TRUE(changed) << changed.error().message;
  return std::move(*made);
}

struct Sample {
  const char* material;
  const char* model;
};
class HeldBase : public testing::TestWithParam<Sample> {};

TEST_P(HeldBase, GoesThroughTheCycleThatTouchafmComputes) {
  SimulatedInstrument instrument = instrument_with([](InstrumentSettings& settings) {
    settings.contact.material = GetParam().material;
    settings.contact.model = GetParam().model;
  });
  const auto cycle = curves::run_curve(instrument.setup(), {}).value();
  std::size_t compared = 0;
  for (const physics::CurveSample& sample : cycle.curve.samples) {
    if (sample.event) continue;  // jump with both samples at its own height
    ASSERT_TRUE(instrument.set_z(sample.z.si, 1e-6));
    ASSERT_NEAR(instrument.shown_force(), sample.force.si, 1e-15)
        << sample.z.si << (sample.branch == physics::Branch::Approach ? " down" : " up");
    ASSERT_EQ(instrument.truth().touching, sample.phase == physics::Phase::Attached) << sample.z.si;
    ++compared;
  }
  EXPECT_GT(compared, 1000U);
  EXPECT_FALSE(instrument.position().engaged);
}

INSTANTIATE_TEST_SUITE_P(Laws, HeldBase,
                         testing::Values(Sample{"mica", "auto"}, Sample{"gold", "dmt"}, Sample{"si3n4", "jkr"},
                                         Sample{"gold", "paper"}, Sample{"mica", "paper-rule"}),
                         [](const auto& row) {
                           std::string name = std::string(row.param.material) + row.param.model;
                           std::erase(name, '-');
                           return name;
                         });

TEST(HeldBaseOfAMicroscope, KeepsTheForceWhenTheFeedbackLetsGo) {
  for (const double setpoint_n : {-1e-10, 5e-10, 2e-8}) {
    SimulatedInstrument instrument = instrument_with(
        [setpoint_n](InstrumentSettings& settings) { settings.scan.setpoint = physics::Force(setpoint_n); });
    instrument.approach(1e-6);
    EXPECT_EQ(instrument.shown_force(), setpoint_n);
    ASSERT_TRUE(instrument.set_z(instrument.position().z_m, 1e-6));
    EXPECT_NEAR(instrument.shown_force(), setpoint_n, 1e-15);
    EXPECT_TRUE(instrument.truth().touching);
    ASSERT_TRUE(instrument.set_z(instrument.position().z_m - 10e-9, 1e-6));
    EXPECT_GT(instrument.shown_force(), setpoint_n);
  }
}

TEST(HeldBaseOfAMicroscope, ShowsNoPullThatNoContactBears) {
  for (const bool engaged_before : {false, true}) {
    SimulatedInstrument instrument = instrument_with([](InstrumentSettings&) {});
    if (engaged_before) instrument.approach(1e-6);
    InstrumentSettings settings(instrument.settings());
    settings.scan.setpoint = physics::Force(-1e-6);
    ASSERT_TRUE(instrument.change(settings));
    instrument.approach(1e-6);
    const double pull_off_n = curves::run_curve(instrument.setup(), {}).value().figures.force_before_joc.si;
    EXPECT_NEAR(instrument.shown_force() / pull_off_n, 1.0, 1e-9);
  }
}

TEST(HeldBaseOfAMicroscope, FeelsTheRelief) {
  SimulatedInstrument instrument = instrument_with([](InstrumentSettings& settings) { settings.flat = false; });
  instrument.approach(1e-6);
  const double z_m = instrument.position().z_m - 20e-9, spring = instrument.setup().material.contact.spring_constant.si;
  ASSERT_TRUE(instrument.set_z(z_m, 1e-6));
  const double force_n = instrument.shown_force(), surface_m = instrument.truth().surface_m;
  double most_m = 0.0;
  for (int step = 1; step <= 20; ++step) {
    instrument.move_to(5e-9 * step, 0.0, 1e-6);
    const double rise_m = instrument.truth().surface_m - surface_m;
    EXPECT_EQ(instrument.position().z_m, z_m);
    EXPECT_NEAR(instrument.shown_force() - force_n, spring * rise_m, 0.05 * spring * std::abs(rise_m) + 1e-14);
    most_m = std::max(most_m, std::abs(rise_m));
  }
  EXPECT_GT(most_m, 1e-10);
}

TEST(HeldBaseOfAMicroscope, LiftsAnAdheringTipOnlyAtItsJumpOffContact) {
  SimulatedInstrument instrument = instrument_with([](InstrumentSettings&) {});
  const double joc_m = curves::run_curve(instrument.setup(), {}).value().figures.z_joc.si;
  instrument.approach(1e-6);
  instrument.withdraw(0.99 * joc_m - instrument.position().z_m, 1e-6);
  EXPECT_TRUE(instrument.truth().touching);
  EXPECT_LT(instrument.shown_force(), 0.0);
  instrument.withdraw(0.02 * joc_m, 1e-6);
  EXPECT_FALSE(instrument.truth().touching);
}

TEST(HeldBaseOfAMicroscope, IsNotLoweredWhileTheLeverTaps) {
  SimulatedInstrument instrument = instrument_with([](InstrumentSettings& settings) {
    settings.taps = true;
    settings.contact.model = "dmt";
  });
  const double z_m = instrument.position().z_m;
  const auto lowered = instrument.set_z(0.0, 1e-6);
  ASSERT_FALSE(lowered);
  EXPECT_THAT(lowered.error().message, HasSubstr("feedback alone"));
  EXPECT_EQ(instrument.position().z_m, z_m);
  ASSERT_TRUE(instrument.set_z(z_m + 1e-9, 1e-6));
  EXPECT_DOUBLE_EQ(instrument.position().z_m, z_m + 1e-9);
}

TEST(HeldBaseOfAMicroscope, ChangesNothingIfTheTipWouldWearTooMuch) {
  SimulatedInstrument instrument = instrument_with([](InstrumentSettings& settings) {
    settings.faults.blunting_force_n = 1e-9;
    settings.faults.blunting_m_per_n = 1e9;
  });
  instrument.approach(1e-6);
  const auto before = instrument.truth();
  const double z_m = instrument.position().z_m;
  const auto pressed = instrument.set_z(z_m - 1e-6, 1e-6);
  ASSERT_FALSE(pressed);
  EXPECT_THAT(pressed.error().message, HasSubstr("wear"));
  EXPECT_EQ(instrument.position().z_m, z_m);
  EXPECT_TRUE(instrument.position().engaged);
  EXPECT_EQ(instrument.truth().tip_radius_m, before.tip_radius_m);
  EXPECT_EQ(instrument.truth().highest_force_n, before.highest_force_n);
}

TEST(HeldBaseOfAMicroscope, WearsAtItsStrongestPush) {
  SimulatedInstrument instrument = instrument_with([](InstrumentSettings& settings) {
    settings.faults.blunting_force_n = 1e-9;
    settings.faults.blunting_m_per_n = 0.5;
  });
  instrument.approach(1e-6);
  ASSERT_TRUE(instrument.set_z(instrument.position().z_m - 50e-9, 1e-6));
  const SimulatedInstrument::Truth truth = instrument.truth();
  EXPECT_GT(truth.highest_force_n, 4e-9);
  EXPECT_NEAR(truth.tip_growth_m, 0.5 * (truth.highest_force_n - 1e-9), 1e-15);
  EXPECT_TRUE(truth.touching) << "the worn tip";
}

}  // namespace held_base_test
}  // namespace afm::instrument
