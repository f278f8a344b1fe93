// SPDX-License-Identifier: Apache-2.0
// The servo over whole cycles of each material, at several speeds of the hand.
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "physics/contact.h"
#include "servo_bench.h"

namespace full_cycle_test {

using namespace afm::scene;
using afm::test::calculated;
using afm::test::kGold;
using afm::test::kMica;
using afm::test::kSiliconNitride;
using afm::test::paper_model;
using afm::test::ServoBench;

// Material, and the highest speed of the hand's aim.
class FullCycle : public testing::TestWithParam<std::tuple<std::int32_t, double>> {
 protected:
  // A minimum-jerk path is 15/8 as fast in its middle as on average (Flash & Hogan 1985).
  static double seconds_for(double distance_m, double top_speed) { return 1.875 * distance_m / top_speed; }

  void cycle() {
    const auto [material, speed] = GetParam();
    bench_.arm(material);
    bench_.move(-0.030, seconds_for(0.090, speed));
    bench_.run(0.3);
    bench_.move(0.072, seconds_for(0.102, speed));
    bench_.run(0.5);
  }

  ServoBench bench_;
};

TEST_P(FullCycle, JumpsOnceEachWayWithTheForcesOfTheEquations) {
  cycle();
  const auto [material, speed] = GetParam();
  const auto expected = calculated(material);
  ASSERT_EQ(bench_.events.size(), 2U);

  const TipEvent& in = bench_.events[0];
  EXPECT_EQ(in.kind, afm::physics::EventKind::JumpToContact);
  EXPECT_EQ(in.material, material);
  EXPECT_NEAR(in.z_m, expected.z_jtc.si, 1e-9 * expected.z_jtc.si);
  EXPECT_NEAR(in.force_after_n, -expected.f_attr.si, 1e-9 * expected.f_attr.si);

  const TipEvent& off = bench_.events[1];
  EXPECT_EQ(off.kind, afm::physics::EventKind::JumpOffContact);
  EXPECT_NEAR(off.z_m, expected.z_joc.si, 1e-9 * expected.z_joc.si);
  EXPECT_NEAR(off.force_before_n, -expected.f_ad.si, 1e-9 * expected.f_ad.si);
  EXPECT_EQ(off.force_after_n, 0.0);

  EXPECT_LT(in.time_ns, off.time_ns);
  EXPECT_LT(bench_.state().safety.excess_energy_j, 1e-6);
  EXPECT_EQ(bench_.state().servo_state, ServoState::Running);
  EXPECT_EQ(bench_.state().fault, FaultCode::None);
}

TEST_P(FullCycle, RecordsEveryTickInOrder) {
  cycle();
  ASSERT_FALSE(bench_.samples.empty());
  for (std::size_t i = 1; i < bench_.samples.size(); ++i) {
    ASSERT_EQ(bench_.samples[i].tick, bench_.samples[i - 1].tick + 1);
    ASSERT_EQ(bench_.samples[i].time_ns, bench_.samples[i - 1].time_ns + 1'000'000);
  }
  EXPECT_EQ(bench_.renderer.lost_samples() + bench_.renderer.refused_blocks(), 0U);
  EXPECT_EQ(bench_.state().garbage_blocks, 0U);
}

TEST_P(FullCycle, PlacesEachEventBetweenTheSamplesAroundIt) {
  cycle();
  ASSERT_GE(bench_.events.size(), 2U);
  for (const TipEvent& event : bench_.events) {
    for (std::size_t i = 1; i < bench_.samples.size(); ++i) {
      if (bench_.samples[i].time_ns < event.time_ns) continue;
      const double before_m = bench_.samples[i - 1].tip.z_m;
      const double after_m = bench_.samples[i].tip.z_m;
      EXPECT_LE(std::min(before_m, after_m), event.z_m);
      EXPECT_GE(std::max(before_m, after_m), event.z_m);
      break;
    }
  }
}

TEST_P(FullCycle, KeepsTheHandsForceWithinTheCapAndTheSlew) {
  cycle();
  ASSERT_GT(bench_.samples.size(), 1000U);
  for (std::size_t i = 1; i < bench_.samples.size(); ++i) {
    ASSERT_LE(std::abs(bench_.samples[i].hand_force_n), 2.0 + 1e-12);
    ASSERT_LE(std::abs(bench_.samples[i].hand_force_n - bench_.samples[i - 1].hand_force_n), 0.5 + 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Hands, FullCycle,
    testing::Combine(testing::Values(kMica, kGold, kSiliconNitride), testing::Values(0.005, 0.02, 0.1, 0.2)),
    [](const auto& test) {
      return std::string(paper_model().materials[static_cast<std::size_t>(std::get<0>(test.param))].name.data()) +
             "At" + std::to_string(std::lround(1e3 * std::get<1>(test.param))) + "mmPerS";
    });

}  // namespace full_cycle_test
