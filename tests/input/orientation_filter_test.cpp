// SPDX-License-Identifier: Apache-2.0
#include "input/orientation_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace afm::input {
namespace orientation_filter_test {

constexpr double kStepS = 0.005;
constexpr glm::dvec3 kUp(0.0, 1.0, 0.0);

// Reading of an ideal sensor that is turned by `level_from_wand` and turns at `rate`, in its own frame.
ImuSample reading(const glm::dquat& level_from_wand, const glm::dvec3& rate = glm::dvec3(0.0)) {
  return {.rate_rad_per_s = rate, .acceleration_g = glm::inverse(level_from_wand) * kUp};
}

glm::dquat yaw(double angle) { return glm::angleAxis(angle, kUp); }
glm::dquat pitch(double angle) { return glm::angleAxis(angle, glm::dvec3(1.0, 0.0, 0.0)); }

double angle_between(const glm::dquat& a, const glm::dquat& b) { return glm::angle(glm::inverse(a) * b); }

TEST(OrientationFilter, KnowsTheTiltFromTheFirstReading) {
  OrientationFilter filter;
  EXPECT_FALSE(filter.valid());
  filter.add(reading(pitch(0.4)), kStepS);
  ASSERT_TRUE(filter.valid());
  EXPECT_NEAR(std::abs(angle_between(filter.level_from_wand(), pitch(0.4))), 0.0, 1e-9);
  EXPECT_NEAR(filter.heading_rad(), 0.0, 1e-12);
}

TEST(OrientationFilter, FollowsTheGyroscope) {
  OrientationFilter filter;
  filter.add(reading(pitch(0.0)), kStepS);
  const double speed = 1.5;
  for (int i = 1; i <= 200; ++i) {
    const glm::dquat now = yaw(speed * i * kStepS);
    filter.add(reading(now, glm::dvec3(0.0, speed, 0.0)), kStepS);
  }
  EXPECT_NEAR(filter.heading_rad(), 1.5, 1e-6);
}

TEST(OrientationFilter, ComesBackToTheTiltThatGravityShows) {
  OrientationFilter filter;
  filter.add(reading(pitch(0.3)), kStepS);
  for (int i = 0; i < 2000; ++i) filter.add(reading(pitch(-0.2)), kStepS);
  EXPECT_NEAR(std::abs(angle_between(filter.level_from_wand(), pitch(-0.2))), 0.0, 0.001);
}

TEST(OrientationFilter, DoesNotTakeASwingForGravity) {
  OrientationFilter filter;
  filter.add(reading(pitch(0.0)), kStepS);
  for (int i = 0; i < 200; ++i) {
    filter.add({.rate_rad_per_s = glm::dvec3(0.0), .acceleration_g = {1.5, 1.0, 0.0}}, kStepS);
  }
  EXPECT_NEAR(std::abs(angle_between(filter.level_from_wand(), pitch(0.0))), 0.0, 1e-9);
}

TEST(OrientationFilter, LearnsTheBiasWhileTheWandLiesStillSoThatTheHeadingStays) {
  OrientationFilter filter;
  const glm::dvec3 bias(0.01, -0.05, 0.02);
  for (int i = 0; i < 400; ++i) filter.add(reading(pitch(0.0), bias), kStepS);
  const double before = filter.heading_rad();
  for (int i = 0; i < 12'000; ++i) filter.add(reading(pitch(0.0), bias), kStepS);
  EXPECT_NEAR(filter.heading_rad(), before, 1e-5) << "within a minute";
}

TEST(OrientationFilter, TakesNoTurningHandForABias) {
  OrientationFilter filter;
  filter.add(reading(pitch(0.0)), kStepS);
  double turned_rad = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    const double rate = 0.3 * std::sin(8.0 * i * kStepS);
    turned_rad += rate * kStepS;
    filter.add(reading(yaw(0.0), glm::dvec3(0.0, rate, 0.0)), kStepS);
  }
  EXPECT_NEAR(filter.heading_rad(), turned_rad, 1e-6);
}

TEST(OrientationFilter, WithoutAGyroscopeFollowsGravityAlone) {
  OrientationFilter filter;
  filter.add(reading(pitch(0.0)), kStepS, false);
  for (int i = 0; i < 200; ++i) filter.add(reading(pitch(0.5)), kStepS, false);
  EXPECT_NEAR(std::abs(angle_between(filter.level_from_wand(), pitch(0.5))), 0.0, 0.001);
}

TEST(OrientationFilter, IsNotShakenByWhatIsNoNumber) {
  OrientationFilter filter;
  filter.add(reading(pitch(0.1)), kStepS);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  filter.add({.rate_rad_per_s = {nan, 0, 0}, .acceleration_g = kUp}, kStepS);
  filter.add({.rate_rad_per_s = glm::dvec3(0.0), .acceleration_g = {0, nan, 0}}, kStepS);
  filter.add(reading(pitch(0.1)), 0.0);
  filter.add({}, kStepS);
  EXPECT_NEAR(std::abs(angle_between(filter.level_from_wand(), pitch(0.1))), 0.0, 1e-9);
}

}  // namespace orientation_filter_test
}  // namespace afm::input
