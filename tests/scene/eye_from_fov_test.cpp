// SPDX-License-Identifier: Apache-2.0
// Invariant: a wall and a headset's field of view have one projection; implausible eyes from a runtime are refused
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "scene/display/wall.h"

namespace afm::scene {
namespace eye_from_fov_test {

constexpr double kExact = 1e-12;
constexpr int kPoses = 200;

EyeView eye_of(const HeadPose& pose, const FieldOfView& fov) {
  return eye_from_fov(pose, fov, DepthConvention::VulkanReversedInfinite, kNearM, 100.0).value();
}

class RandomEyes : public ::testing::Test {
 protected:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  HeadPose pose() {
    const glm::dquat turn(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
    return {.position_m = {between(-2, 2), between(0, 2), between(-2, 2)}, .room_from_head = glm::normalize(turn)};
  }
  FieldOfView fov() {
    return {.left_rad = between(-1.2, -0.1),
            .right_rad = between(0.1, 1.2),
            .down_rad = between(-1.2, -0.1),
            .up_rad = between(0.1, 1.2)};
  }

  std::mt19937 random_{22};
};

// The definition by angles only: a point at an angle's tangent is at the border of the picture.
TEST_F(RandomEyes, SeePointsWhereTheirAnglesPutThem) {
  for (int i = 0; i < kPoses; ++i) {
    const HeadPose head = pose();
    const FieldOfView field = fov();
    const EyeView eye = eye_of(head, field);
    const double across = between(0, 1), down = between(0, 1), distance_m = between(0.2, 50.0);
    const double x = std::tan(field.left_rad) + across * (std::tan(field.right_rad) - std::tan(field.left_rad));
    const double y = std::tan(field.up_rad) + down * (std::tan(field.down_rad) - std::tan(field.up_rad));
    const glm::dvec3 point = head.position_m + head.room_from_head * (distance_m * glm::dvec3(x, y, -1.0));
    const glm::dvec4 clip = eye.projection * eye.view * glm::dvec4(point, 1.0);
    EXPECT_NEAR(clip.x / clip.w, 2.0 * across - 1.0, 1e-9);
    EXPECT_NEAR(clip.y / clip.w, 2.0 * down - 1.0, 1e-9);  // Vulkan's y points down
    EXPECT_NEAR(clip.z / clip.w, kNearM / distance_m, kExact);
    EXPECT_EQ(eye.eye_position_m, head.position_m);
  }
}

TEST_F(RandomEyes, HaveDepthOneAtTheNearPlaneAndZeroAtInfinity) {
  const HeadPose head = pose();
  const EyeView eye = eye_of(head, fov());
  const glm::dvec3 ahead = head.room_from_head * glm::dvec3(0.0, 0.0, -1.0);
  const glm::dvec4 near = eye.projection * eye.view * glm::dvec4(head.position_m + kNearM * ahead, 1.0);
  EXPECT_NEAR(near.z / near.w, 1.0, kExact);
  const glm::dvec4 far = eye.projection * eye.view * glm::dvec4(ahead, 0.0);
  EXPECT_NEAR(far.z / far.w, 0.0, kExact);
}

// One projection function: the off-axis view of the rectangle that fills the field of view gives the same picture.
TEST_F(RandomEyes, SeeWhatTheOffAxisViewOfTheirScreenSees) {
  for (int i = 0; i < kPoses; ++i) {
    const HeadPose head = pose();
    const FieldOfView field = fov();
    const EyeView eye = eye_of(head, field);
    const EyeView wall = off_axis_view(screen_of_fov(head, field, between(0.5, 5.0)), head.position_m,
                                       DepthConvention::VulkanReversedInfinite, kNearM, 100.0)
                             .value();
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        EXPECT_NEAR(eye.projection[column][row], wall.projection[column][row], 1e-9);
        EXPECT_NEAR(eye.view[column][row], wall.view[column][row], 1e-9);
      }
    }
  }
}

// Canted displays: each eye looks along its own pose, and both lines of sight through a point meet in it.
TEST_F(RandomEyes, LinesOfSightOfTwoCantedEyesMeetInThePoint) {
  const auto eye = [&](double side, double turn_rad) {
    return HeadPose{.position_m = {side * 0.032, 1.6, 0.0},
                    .room_from_head = glm::angleAxis(turn_rad, glm::dvec3(0.0, 1.0, 0.0))};
  };
  const FieldOfView field = fov();
  const glm::dvec3 point(0.2, 1.4, -2.0);
  std::array<glm::dvec3, 2> at{}, along{};
  for (std::size_t i = 0; i < 2; ++i) {
    const HeadPose pose = eye(i == 0 ? -1.0 : 1.0, i == 0 ? 0.09 : -0.09);
    const EyeView view = eye_of(pose, field);
    const glm::dvec4 clip = view.projection * view.view * glm::dvec4(point, 1.0);
    const glm::dvec4 back =
        glm::inverse(view.projection * view.view) * glm::dvec4(clip.x / clip.w, clip.y / clip.w, 0.5, 1.0);
    at[i] = pose.position_m;
    along[i] = glm::normalize(glm::dvec3(back) / back.w - pose.position_m);
  }
  const glm::dvec3 normal = glm::normalize(glm::cross(along[0], along[1]));
  EXPECT_LT(std::abs(glm::dot(at[1] - at[0], normal)), 1e-4);
  const double s = glm::dot(glm::cross(at[1] - at[0], along[1]), normal) / glm::length(glm::cross(along[0], along[1]));
  EXPECT_LT(glm::distance(at[0] + s * along[0], point), 1e-4);
}

TEST(EyeFromFov, RefusesWhatNoEyeHas) {
  const HeadPose pose{};
  const FieldOfView field{.left_rad = -0.7, .right_rad = 0.7, .down_rad = -0.7, .up_rad = 0.7};
  const auto refused = [](const HeadPose& p, const FieldOfView& f) {
    return !eye_from_fov(p, f, DepthConvention::VulkanReversedInfinite, kNearM, 100.0);
  };
  EXPECT_FALSE(refused(pose, field));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused(pose, {0.7, -0.7, -0.7, 0.7}));
  EXPECT_TRUE(refused(pose, {-0.7, 0.7, 0.7, 0.7}));
  EXPECT_TRUE(refused(pose, {-1.6, 0.7, -0.7, 0.7}));
  EXPECT_TRUE(refused(pose, {kNan, 0.7, -0.7, 0.7}));
  EXPECT_TRUE(refused({.position_m = {kNan, 0, 0}}, field));
  EXPECT_TRUE(refused({.room_from_head = {0, 0, 0, 0}}, field));
  EXPECT_TRUE(refused({.room_from_head = {kNan, 0, 0, 0}}, field));
}

}  // namespace eye_from_fov_test
}  // namespace afm::scene
