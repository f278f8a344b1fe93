// SPDX-License-Identifier: Apache-2.0
#include "input/simulated_wand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "input/selection.h"

namespace afm::input {
namespace simulated_wand_test {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(SimulatedWand, PointsAtItsAimOnceItHasArrived) {
  SimulatedWand wand({0.3, 1.1, 1.8});
  const glm::dvec3 aim(-0.5, 0.6, 0.2);
  wand.aim_at(aim, 1.0, 0);
  EXPECT_FALSE(wand.arrived(kSecond / 2));
  ASSERT_TRUE(wand.arrived(kSecond));
  const Ray ray = ray_of(wand.state(kSecond));
  EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-12);
  EXPECT_GT(glm::dot(ray.direction, glm::normalize(aim - ray.origin_m)), std::cos(0.005));
}

TEST(SimulatedWand, HoversOnlyTheSwatchThatItAimsAtWhileItsHandTrembles) {
  const std::vector<Target> swatches{{{-0.5, 0.6, 0.2}, 0.15}, {{0.0, 0.6, 0.2}, 0.15}, {{0.5, 0.6, 0.2}, 0.15}};
  SimulatedWand wand({0.3, 1.1, 1.8});
  wand.aim_at(swatches[1].center_m, 0.5, 0);
  Selector selector;
  for (std::int64_t t = kSecond; t < 11 * kSecond; t += kSecond / 60) {
    ASSERT_EQ(selector.update(wand.state(t), {0.0, 1.65, 2.5}, swatches).hovered, 1U) << "at " << t << " ns";
  }
}

TEST(SimulatedWand, HoldsTheButtonAsLongAsRequested) {
  SimulatedWand wand({0, 1, 2});
  wand.press(0.2, kSecond);
  EXPECT_FALSE(wand.state(kSecond - 1).pressed(WandButton::Select));
  EXPECT_TRUE(wand.state(kSecond).pressed(WandButton::Select));
  EXPECT_FALSE(wand.state(kSecond + kSecond / 5).pressed(WandButton::Select));
}

}  // namespace simulated_wand_test
}  // namespace afm::input
