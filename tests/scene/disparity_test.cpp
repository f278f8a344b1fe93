// SPDX-License-Identifier: Apache-2.0
#include "scene/display/disparity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

#include "support/stereo_cases.h"

namespace afm::scene {
namespace disparity_test {

using test::StereoCase;

std::string case_name(const ::testing::TestParamInfo<StereoCase>& info) { return info.param.id; }

class ComfortRow : public ::testing::TestWithParam<StereoCase> {};

TEST_P(ComfortRow, GivesTheDepthsAndTheirParallax) {
  const double distance = GetParam().inputs[0], ipd = GetParam().inputs[1];
  const ComfortZone zone = comfort_zone(distance, ipd, glm::radians(GetParam().inputs[2]));
  const auto near_to = [](double a, double b) { return a == b || std::abs(a - b) <= 1e-9 * std::abs(b); };
  EXPECT_PRED2(near_to, zone.nearest_m, GetParam().expected[0]);
  EXPECT_PRED2(near_to, zone.farthest_m, GetParam().expected[1]);
  EXPECT_PRED2(near_to, 1e3 * disparity_at(distance, ipd, zone.nearest_m).uncrossed_m, GetParam().expected[2]);
  EXPECT_PRED2(near_to, 1e3 * disparity_at(distance, ipd, zone.farthest_m).uncrossed_m, GetParam().expected[3]);
}

INSTANTIATE_TEST_SUITE_P(Stereo, ComfortRow, ::testing::ValuesIn(test::stereo_cases("comfort")), case_name);

TEST(ResearchComfort, WasAllRead) { EXPECT_EQ(test::stereo_cases("comfort").size(), 4U); }

TEST(Disparity, IsCrossedBeforeTheWallNothingOnItAndNeverMoreThanTheEyesAreApartBehind) {
  constexpr double kIpd = 0.063, kWall = 2.5;
  EXPECT_EQ(disparity_at(kWall, kIpd, kWall).uncrossed_m, 0.0);
  EXPECT_EQ(disparity_at(kWall, kIpd, kWall).crossed_rad, 0.0);
  double before = -std::numeric_limits<double>::infinity();
  for (double depth = 0.1; depth < 1e6; depth *= 1.3) {
    const Disparity at = disparity_at(kWall, kIpd, depth);
    EXPECT_EQ(at.crossed_rad > 0, depth < kWall);
    EXPECT_GT(at.uncrossed_m, before);
    EXPECT_LT(at.uncrossed_m, kIpd);
    before = at.uncrossed_m;
  }
  EXPECT_EQ(disparity_at(kWall, kIpd, std::numeric_limits<double>::infinity()).uncrossed_m, kIpd);
}

TEST(ComfortZone, ReachesFartherForEyesThatAreCloserTogether) {
  EXPECT_GT(comfort_zone(2.5, 0.050, kComfortableDisparityRad).farthest_m,
            comfort_zone(2.5, 0.065, kComfortableDisparityRad).farthest_m);
}

}  // namespace disparity_test
}  // namespace afm::scene
