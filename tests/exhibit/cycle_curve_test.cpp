// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/cycle_curve.h"

#include <gtest/gtest.h>

namespace afm::exhibit {
namespace cycle_curve_test {

scene::TipSample sample(std::int64_t ms, double z_nm, scene::ServoState state = scene::ServoState::Running) {
  scene::TipSample s;
  s.time_ns = ms * 1'000'000;
  s.tip.z_m = z_nm * 1e-9;
  s.servo_state = state;
  s.phase = physics::Phase::Free;
  return s;
}

servo::RecordedSession v_shaped() {
  servo::RecordedSession session;
  for (int i = 0; i <= 20; ++i) session.samples.push_back(sample(i, std::abs(i - 10) - 3.0));
  scene::TipEvent in;
  in.time_ns = 7'500'000;
  in.z_m = -0.5e-9;
  in.force_after_n = -0.24e-9;
  session.events.push_back(in);
  return session;
}

TEST(CycleCurve, IsSplitAtTheDeepestPush) {
  const render::PlotCurve plot = curve_until(v_shaped(), 20'000'000).plot("mica", glm::vec3(1.0F));
  EXPECT_DOUBLE_EQ(plot.approach.back().place_nm, -3.0);
  EXPECT_DOUBLE_EQ(plot.retract.front().place_nm, -3.0);
  EXPECT_DOUBLE_EQ(plot.retract.back().place_nm, 7.0);
}

TEST(CycleCurve, HoldsEverySampleAndBothEndsOfTheJump) {
  const render::PlotCurve plot = curve_until(v_shaped(), 20'000'000).plot("mica", glm::vec3(1.0F));
  // the deepest point ends one part and begins the other
  EXPECT_EQ(plot.approach.size() + plot.retract.size(), 21U + 2U + 1U);
  EXPECT_DOUBLE_EQ(plot.approach[8].place_nm, -0.5);
  EXPECT_DOUBLE_EQ(plot.approach[8].force_nn, 0.0);
  EXPECT_DOUBLE_EQ(plot.approach[9].force_nn, -0.24);
}

TEST(CycleCurve, GrowsWithTime) {
  EXPECT_TRUE(curve_until(v_shaped(), -1).empty());
  EXPECT_EQ(curve_until(v_shaped(), 3'000'000).plot("", {}).approach.size(), 4U);
}

TEST(CycleCurve, LeavesOutWhatIsNotFelt) {
  CycleCurve curve;
  curve.add(sample(0, 5.0, scene::ServoState::Disarmed));
  scene::TipSample waiting = sample(1, 5.0);
  waiting.phase = physics::Phase::WaitForLift;
  curve.add(waiting);
  EXPECT_TRUE(curve.empty());
}

}  // namespace cycle_curve_test
}  // namespace afm::exhibit
