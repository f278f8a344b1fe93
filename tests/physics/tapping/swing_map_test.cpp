// SPDX-License-Identifier: Apache-2.0
// States of a tapping lever by Newton's method on one swing of direct integration.
#include "physics/tapping/swing_map.h"

#include <gtest/gtest.h>

#include <vector>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/tapped_sample.h"
#include "physics/tapping/tapping_oscillator.h"

namespace afm::physics {
namespace swing_map_test {

using namespace literals;

// A soft lever over a stiff contact that adheres: averages have its attractive state only.
const TappedSample kSoft{
    .k = 0.858385, .q = 273.884950, .a0_nm = 9.374816, .r_nm = 48.3545, .h_zj = 18.9712, .e_gpa = 91.647};
constexpr Length kSoftHeight{7.7119179938321576e-9};

std::vector<TapState> averaged_at(const TappedSample& sample, Length z) {
  AveragedFlow flow(sample.surface(), sample.lever());
  std::vector<TapState> states;
  for (const RestingTap& tap : flow.resting_at(z)) states.push_back(tap.state);
  return states;
}

TEST(SwingMap, HasTheStatesOfAveragesAndOfTheSettledTip) {
  const TappedSample sample;
  SwingMap map(sample.surface(), sample.lever());
  TappingOscillator tip(sample.surface(), sample.lever());
  const std::vector<TapState> averaged = averaged_at(sample, 17.4149_nm);
  ASSERT_EQ(averaged.size(), 3U);
  const std::vector<DirectSwing> resting = map.stable_beside({}, 17.4149_nm);
  ASSERT_EQ(resting.size(), 2U);
  for (const std::size_t i : {0U, 1U}) {
    const TapState rest = resting[i].state, average = averaged[2 * i];
    tip.place(17.4149_nm, average);
    const TapState settled = tip.settle().state;
    EXPECT_NEAR(nm_of(rest.amplitude), nm_of(settled.amplitude), 2e-3);
    EXPECT_NEAR(degrees_of(rest.phase), degrees_of(settled.phase), 0.1);
    EXPECT_NEAR(nm_of(rest.amplitude), nm_of(average.amplitude), 2e-2);
  }
  EXPECT_TRUE(map.stable_beside(averaged, 17.4149_nm).empty());
}

TEST(SwingMap, FindsTheRepulsiveStateOfASoftLeverThatAveragesLack) {
  const std::vector<TapState> averaged = averaged_at(kSoft, kSoftHeight);
  ASSERT_EQ(averaged.size(), 1U);
  SwingMap map(kSoft.surface(), kSoft.lever());
  const std::vector<DirectSwing> beside = map.stable_beside(averaged, kSoftHeight);
  ASSERT_EQ(beside.size(), 1U);
  // value of direct integration with sixteen times as many steps
  EXPECT_NEAR(nm_of(beside[0].state.amplitude), 7.524536, 1e-4);
  EXPECT_NEAR(degrees_of(beside[0].state.phase), 53.4237, 0.05);
  EXPECT_GT(beside[0].averages.contact_share, 0.02);
}

// A soft lever deep in a soft sample: the one state of 20 set-ups with 1000 starts each that neither averages nor
// Newton's method found, for the steps of direct integration hold the swing.
TEST(SwingMap, FindsAStateThatFewStartsReach) {
  const TappedSample deep{
      .k = 0.505941, .q = 443.426796, .a0_nm = 46.006653, .r_nm = 17.014937, .h_zj = 189.418908, .e_gpa = 0.178370};
  constexpr Length kHeight{32.15393633345716e-9};
  SwingMap map(deep.surface(), deep.lever());
  const std::vector<DirectSwing> beside = map.stable_beside(averaged_at(deep, kHeight), kHeight);
  ASSERT_EQ(beside.size(), 1U);
  // value of direct integration with sixteen times as many steps
  EXPECT_NEAR(nm_of(beside[0].state.amplitude), 40.5428, 1e-3);
  EXPECT_NEAR(degrees_of(beside[0].state.phase), 62.506, 0.1);
}

// A base below the surface presses the tip in: no swing is as wide as its height is negative.
TEST(SwingMap, FindsNoSwingOfANegativeWidth) {
  const TappedSample sample;
  SwingMap map(sample.surface(), sample.lever());
  for (const DirectSwing& swing : map.stable_beside({}, -0.5_nm)) EXPECT_GT(swing.state.amplitude, 0.0_nm);
}

}  // namespace swing_map_test
}  // namespace afm::physics
