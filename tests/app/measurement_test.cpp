// SPDX-License-Identifier: Apache-2.0
#include "app/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "physics/contact.h"

namespace afm::app {
namespace {

scene::MaterialEntry mica() {
  auto library = scene::load_materials(AFM_SOURCE_DIR "/assets/materials.toml");
  return *library.value().find("mica");
}

RecordedSession cycle(double error) {
  const auto events = physics::approach_retract_events(mica().interaction);
  RecordedSession session;
  session.material = "mica";
  session.samples.resize(1);
  scene::TipEvent in, out;
  in.kind = scene::TipEventKind::JumpToContact;
  in.z_m = events.z_jtc.si;
  in.force_after_n = -events.f_attr.si * (1.0 + error);
  out.kind = scene::TipEventKind::JumpOffContact;
  out.z_m = events.z_joc.si;
  out.force_before_n = -events.f_ad.si;
  session.events = {in, out};
  return session;
}

TEST(Measurement, OfAnExactCycleHasNoError) {
  const auto m = measure(cycle(0.0), mica());
  ASSERT_TRUE(m.has_value());
  EXPECT_LT(m->worst_error(), 1e-12);
  EXPECT_NEAR(m->experiment_error_f_attr(), 0.23975 / 0.24 - 1.0, 1e-4);
}

TEST(Measurement, SeesAnEventThatIsOff) {
  EXPECT_GT(measure(cycle(0.002), mica())->worst_error(), kEventErrorBound);
  EXPECT_LT(measure(cycle(0.0005), mica())->worst_error(), kEventErrorBound);
}

TEST(Measurement, FailsWithoutAJumpOffContact) {
  RecordedSession session = cycle(0.0);
  session.events.pop_back();
  const auto m = measure(session, mica());
  ASSERT_FALSE(m.has_value());
  EXPECT_THAT(m.error().message, ::testing::HasSubstr("no jump off contact"));
}

TEST(Percentiles, OfAHundredValuesAreThoseValues) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Percentiles p = percentiles(values);
  EXPECT_EQ(p.p50, 50.0);
  EXPECT_EQ(p.p99, 99.0);
  EXPECT_EQ(p.p999, 100.0);
  EXPECT_EQ(p.max, 100.0);
}

TEST(Percentiles, OfAHistogramAreTheBinsUpperEdges) {
  std::array<std::uint32_t, 101> bins{};
  for (std::size_t i = 0; i < 99; ++i) bins[i] = 1;
  bins[100] = 1;  // longer than all bins
  const Percentiles p = percentiles(bins, 4321);
  EXPECT_EQ(p.p50, 50.0);
  EXPECT_EQ(p.p99, 99.0);
  EXPECT_EQ(p.p999, 4321.0);
}

TEST(Percentiles, OfNothingAreZero) {
  EXPECT_EQ(percentiles(std::vector<double>{}).max, 0.0);
  EXPECT_EQ(percentiles(std::array<std::uint32_t, 3>{}, 0).p50, 0.0);
}

}  // namespace
}  // namespace afm::app
