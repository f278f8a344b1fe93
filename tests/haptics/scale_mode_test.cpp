// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "physics/contact.h"
#include "servo_bench.h"

namespace scale_mode_test {

using afm::physics::Phase;
using afm::scene::ScaleMode;
using afm::scene::ServoState;
using afm::test::kGold;
using afm::test::kMica;
using afm::test::kSiliconNitride;
using afm::test::ServoBench;

afm::physics::ApproachRetractEvents calculated(std::int32_t material) {
  return afm::physics::approach_retract_events(
      afm::test::paper_model().materials[static_cast<std::size_t>(material)].contact);
}

class CycleOnAScale : public testing::TestWithParam<std::tuple<std::int32_t, ScaleMode>> {};

TEST_P(CycleOnAScale, HasTheEventsOfTheEquationsAndLetsGoWithinTheWorkspace) {
  const auto [material, mode] = GetParam();
  ServoBench bench;
  bench.choose(material, mode);
  bench.move(0.070, 0.5);
  bench.run(1.0);
  bench.aim(0.070, 0.0, true);
  bench.run(0.1);
  bench.aim(0.070, 0.0);
  bench.run(0.6);
  ASSERT_EQ(bench.state().servo_state, ServoState::Running);
  EXPECT_EQ(bench.state().active.scale_mode, mode);
  bench.move(-0.030, 2.0);
  bench.run(0.3);
  bench.move(0.070, 2.0);
  bench.run(0.5);

  const auto expected = calculated(material);
  ASSERT_EQ(bench.events.size(), 2U);
  EXPECT_NEAR(bench.events[0].force_after_n, -expected.f_attr.si, 1e-9 * expected.f_attr.si);
  EXPECT_NEAR(bench.events[1].force_before_n, -expected.f_ad.si, 1e-9 * expected.f_ad.si);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  const auto strongest = std::max_element(bench.samples.begin(), bench.samples.end(), [](const auto& a, const auto& b) {
    return std::abs(a.hand_force_n) < std::abs(b.hand_force_n);
  });
  EXPECT_LE(std::abs(strongest->hand_force_n), 2.0 * (1 + 1e-9));
  for (const auto& sample : bench.samples) {
    if (sample.material >= 0) {
      ASSERT_EQ(sample.scale_mode, mode);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Papers, CycleOnAScale,
                         testing::Combine(testing::Values(kMica, kGold, kSiliconNitride),
                                          testing::Values(ScaleMode::Common, ScaleMode::Fit, ScaleMode::Compressed,
                                                          ScaleMode::Atoms)));

TEST(ScaleMode, ChangesOnlyOffTheSampleAndWithoutForce) {
  ServoBench bench;
  bench.hold_attached(kMica);
  bench.choose(kMica, ScaleMode::Compressed);
  bench.run(0.3);
  EXPECT_EQ(bench.state().active.scale_mode, ScaleMode::Fit);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  EXPECT_LT(bench.state().acknowledged.selection, bench.selection);

  bench.samples.clear();
  bench.move(ServoBench::kTop, 0.5);
  bench.run(0.5);
  EXPECT_EQ(bench.state().active.scale_mode, ScaleMode::Compressed);
  EXPECT_EQ(bench.state().acknowledged.selection, bench.selection);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  const auto first = std::find_if(bench.samples.begin(), bench.samples.end(),
                                  [](const auto& s) { return s.scale_mode == ScaleMode::Compressed; });
  ASSERT_NE(first, bench.samples.end());
  EXPECT_EQ((first - 1)->hand_force_n, 0.0);
  EXPECT_EQ(first->hand_force_n, 0.0);
}

TEST(ScaleMode, StaysWhenTheMaterialUnderTheTipIsEdited) {
  ServoBench bench;
  bench.arm(kMica, ScaleMode::Common);
  const double before = bench.state().active.scale.hand_m_per_m;
  auto changed = bench.segment.model().materials[kMica];
  changed.contact.spring_constant.si *= 1.5;
  bench.edit(kMica, changed);
  bench.run(0.3);
  EXPECT_EQ(bench.state().active.edit_revision, bench.edits);
  EXPECT_EQ(bench.state().active.scale_mode, ScaleMode::Common);
  EXPECT_EQ(bench.state().active.scale.hand_m_per_m, before);
}

TEST(ScaleMode, IsTheSameOnTheCommonScaleOfARecording) {
  ServoBench all;
  all.arm(kMica, ScaleMode::Common);
  auto alone = afm::test::paper_model();
  alone.material_count = 1;
  alone.common_hand_m_per_m = all.state().active.scale.hand_m_per_m;
  alone.common_hand_n_per_n = all.state().active.scale.hand_n_per_n;
  ServoBench again(alone);
  again.arm(kMica, ScaleMode::Common);
  EXPECT_EQ(again.state().active.scale.hand_m_per_m, all.state().active.scale.hand_m_per_m);
  EXPECT_EQ(again.state().active.scale.hand_n_per_n, all.state().active.scale.hand_n_per_n);
  EXPECT_EQ(again.state().hand.force_n, all.state().hand.force_n);

  alone.common_hand_n_per_n = 0.0;
  EXPECT_FALSE(afm::scene::validate(alone));
}

TEST(ScaleMode, OfNoKindThatIsKnownIsRefused) {
  ServoBench bench;
  bench.choose(kMica, static_cast<ScaleMode>(7));
  bench.run(0.01);
  EXPECT_EQ(bench.state().material, -1);
  EXPECT_GT(bench.state().garbage_blocks, 0U);
}

}  // namespace scale_mode_test
