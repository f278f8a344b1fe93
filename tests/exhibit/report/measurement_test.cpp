// SPDX-License-Identifier: Apache-2.0
#include "exhibit/report/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "core/percentiles.h"
#include "support/places.h"

namespace afm::exhibit {
namespace measurement_test {

curves::SampleModel mica(physics::Law law = physics::Law::Paper) {
  const auto library = scene::load_materials(support::source("assets/materials.toml"));
  curves::ContactSetup setup{*library.value().find("mica"), {}, {}};
  setup.model.law = law;
  return curves::make_sample_model(setup).value();
}

// A cycle of the law whose jump to contact pulls too hard by this part.
servo::RecordedSession cycle(double error, const curves::SampleModel& material = mica()) {
  const physics::CycleFigures& figures = material.figures();
  servo::RecordedSession session;
  session.material = "mica";
  session.samples.resize(1);
  scene::TipEvent in, out;
  in.kind = physics::EventKind::JumpToContact;
  in.z_m = figures.z_jtc.si;
  in.force_after_n = figures.force_after_jtc.si * (1.0 + error);
  out.kind = physics::EventKind::JumpOffContact;
  out.z_m = figures.z_joc.si;
  out.force_before_n = figures.force_before_joc.si;
  session.events = {in, out};
  return session;
}

TEST(Measurement, OfAnExactCycleHasNoError) {
  const auto m = measure(cycle(0.0), mica());
  ASSERT_TRUE(m.has_value());
  EXPECT_LT(m->worst_error(), 1e-12);
  EXPECT_NEAR(m->experiment_error_f_attr().value(), 0.23975 / 0.24 - 1.0, 1e-4);
}

TEST(Measurement, SeesAnEventThatIsOff) {
  EXPECT_GT(measure(cycle(0.002), mica())->worst_error(), kEventErrorBound);
  EXPECT_LT(measure(cycle(0.0005), mica())->worst_error(), kEventErrorBound);
}

TEST(Measurement, OfARecordingJudgesItsLoopEnergyToo) {
  const curves::SampleModel felt = mica();
  physics::CurveFeatures recorded;
  recorded.loop_energy = 1.02 * felt.figures().loop_energy;
  const auto m = measure(cycle(0.0, felt), felt, &recorded);
  ASSERT_TRUE(m.has_value());
  EXPECT_NEAR(m->error_of_loop_energy(), 1.0 / 1.02 - 1.0, 1e-12);
  EXPECT_GT(m->worst_error(), m->error_bound());
  recorded.loop_energy = felt.figures().loop_energy;
  EXPECT_EQ(measure(cycle(0.0, felt), felt, &recorded)->error_of_loop_energy(), 0.0);
  EXPECT_EQ(measure(cycle(0.0, felt), felt)->error_of_loop_energy(), 0.0);
}

TEST(Measurement, IsMadeAgainstTheFiguresOfTheLawThatWasFelt) {
  const curves::SampleModel dmt = mica(physics::Law::Dmt);
  const auto m = measure(cycle(0.0, dmt), dmt);
  ASSERT_TRUE(m.has_value());
  EXPECT_EQ(m->law, "dmt");
  EXPECT_LT(m->worst_error(), 1e-12);
  EXPECT_NEAR(m->calculation.f_attr_n, 0.2034e-9, 1e-13);
  EXPECT_GT(measure(cycle(0.0), dmt)->worst_error(), kEventErrorBound);
}

TEST(Measurement, OfALeverThatJumpsNowhereHasNothingToCompare) {
  curves::SampleModel stiff = mica(physics::Law::Dmt);
  curves::ContactSetup changed = stiff.setup;
  changed.material.contact.spring_constant.si = 40.0;
  stiff = curves::make_sample_model(stiff, changed).value();
  servo::RecordedSession session = cycle(0.0);
  session.events.clear();
  const auto m = measure(session, stiff);
  ASSERT_TRUE(m.has_value());
  EXPECT_FALSE(m->hysteretic);
  EXPECT_EQ(m->worst_error(), 0.0);
}

TEST(Measurement, DoesNotJudgeADynamicLever) {
  curves::SampleModel dynamic = mica(physics::Law::Dmt);
  dynamic.parameters.dynamic = 1;
  EXPECT_EQ(measure(cycle(0.3, dynamic), dynamic)->worst_error(), 0.0);
}

TEST(Measurement, FailsWithoutAJumpOffContact) {
  servo::RecordedSession session = cycle(0.0);
  session.events.pop_back();
  const auto m = measure(session, mica());
  ASSERT_FALSE(m.has_value());
  EXPECT_THAT(m.error().message, ::testing::HasSubstr("no jump off contact"));
}

TEST(Percentiles, OfAHundredValuesAreThoseValues) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const core::Percentiles p = core::percentiles(values);
  EXPECT_EQ(p.p50, 50.0);
  EXPECT_EQ(p.p99, 99.0);
  EXPECT_EQ(p.p999, 100.0);
  EXPECT_EQ(p.max, 100.0);
}

TEST(Percentiles, OfAHistogramAreTheBinsUpperEdges) {
  std::array<std::uint32_t, 101> bins{};
  for (std::size_t i = 0; i < 99; ++i) bins[i] = 1;
  bins[100] = 1;  // longer than all bins
  const core::Percentiles p = core::percentiles(bins, 4321);
  EXPECT_EQ(p.p50, 50.0);
  EXPECT_EQ(p.p99, 99.0);
  EXPECT_EQ(p.p999, 4321.0);
}

TEST(Percentiles, OfNothingAreZero) {
  EXPECT_EQ(core::percentiles(std::vector<double>{}).max, 0.0);
  EXPECT_EQ(core::percentiles(std::array<std::uint32_t, 3>{}, 0).p50, 0.0);
}

}  // namespace measurement_test
}  // namespace afm::exhibit
