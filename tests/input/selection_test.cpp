// SPDX-License-Identifier: Apache-2.0
#include "input/selection.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>
#include <numbers>
#include <vector>

namespace afm::input {
namespace selection_test {

constexpr double kDegree = std::numbers::pi / 180.0;

struct PickCase {
  const char* name;
  Ray ray;
  double cone_deg;
  std::vector<Target> targets;
  std::optional<std::size_t> expected;
};

// The rows select_* of the research's test vectors.
class ResearchCases : public ::testing::TestWithParam<PickCase> {};

TEST_P(ResearchCases, PickTheNamedTarget) {
  PickCase c = GetParam();
  c.ray.direction = glm::normalize(c.ray.direction);
  EXPECT_EQ(pick(c.ray, c.cone_deg * kDegree, c.targets), c.expected);
}

INSTANTIATE_TEST_SUITE_P(
    Select, ResearchCases,
    ::testing::Values(
        PickCase{"select_001",
                 {{0, 1.2, 1.5}, {0, 0, -1}},
                 5,
                 {{{0, 1.2, -1}, 0.15}, {{0.4, 1.2, -1}, 0.15}, {{-0.4, 1.2, -1}, 0.15}},
                 0},
        PickCase{"select_002", {{0, 1.2, 1.5}, {0.1, 0, -1}}, 5, {{{0, 1.2, -1}, 0.1}, {{0.4, 1.2, -1}, 0.1}}, 1},
        PickCase{"select_004", {{0, 1.2, 1.5}, {0, 0, -1}}, 5, {{{0, 1.2, -2}, 0.15}, {{0, 1.2, -1}, 0.15}}, 1},
        PickCase{"select_005",
                 {{0.2, 1.1, 1.4}, {-0.05, 0.02, -1}},
                 3,
                 {{{0, 1.2, -1}, 0.05}, {{0.12, 1.15, -0.5}, 0.05}, {{-0.2, 1.1, -2}, 0.05}},
                 1}),
    [](const auto& param) { return param.param.name; });

TEST(Pick, FindsNothingOutsideTheCone) {
  const std::vector<Target> targets{{{1.0, 0.0, -1.0}, 0.05}};
  EXPECT_EQ(pick({{0, 0, 0}, {0, 0, -1}}, kPickConeRad, targets), std::nullopt);
}

TEST(Pick, FindsNothingBehindTheWand) {
  const std::vector<Target> targets{{{0.0, 0.0, 1.0}, 0.1}};
  EXPECT_EQ(pick({{0, 0, 0}, {0, 0, -1}}, kPickConeRad, targets), std::nullopt);
}

constexpr glm::dvec3 kEye(0.0, 0.3, 0.0);

WandState pointing_at_first(bool pressed) {
  WandState wand;
  wand.orientation_valid = true;
  if (pressed) wand.buttons = bit(WandButton::Select);
  return wand;
}

TEST(Selector, ChoosesOnceForEachPress) {
  const std::vector<Target> targets{{{0.0, 0.0, -2.0}, 0.2}};
  Selector selector;
  EXPECT_EQ(selector.update(pointing_at_first(false), kEye, targets).hovered, 0U);
  EXPECT_EQ(selector.update(pointing_at_first(true), kEye, targets).chosen, 0U);
  EXPECT_EQ(selector.update(pointing_at_first(true), kEye, targets).chosen, std::nullopt);
  EXPECT_EQ(selector.update(pointing_at_first(false), kEye, targets).chosen, std::nullopt);
  EXPECT_EQ(selector.update(pointing_at_first(true), kEye, targets).chosen, 0U);
}

TEST(Selector, ChoosesNothingWithoutAPose) {
  const std::vector<Target> targets{{{0.0, 0.0, -2.0}, 0.2}};
  Selector selector;
  WandState lost = pointing_at_first(true);
  lost.orientation_valid = false;
  const Selector::Result result = selector.update(lost, kEye, targets);
  EXPECT_EQ(result.hovered, std::nullopt);
  EXPECT_EQ(result.chosen, std::nullopt);
}

TEST(Selector, TakesAButtonThatStayedDownWhileThePoseWasLostForNoNewPress) {
  const std::vector<Target> targets{{{0.0, 0.0, -2.0}, 0.2}};
  Selector selector;
  selector.update(pointing_at_first(true), kEye, targets);
  WandState lost = pointing_at_first(true);
  lost.orientation_valid = false;
  selector.update(lost, kEye, targets);
  EXPECT_EQ(selector.update(pointing_at_first(true), kEye, targets).chosen, std::nullopt);
}

// The hand is low and points below the front target at the one behind it, which the eye cannot see.
TEST(Selector, HoversWhatTheEyeSeesThoughTheHandReachesBehindIt) {
  const std::vector<Target> targets{{{0.0, 0.0, -2.0}, 0.3}, {{0.0, 0.0, -3.0}, 0.2}};
  const glm::dvec3 eye(0.0, 0.0, 0.0);
  EXPECT_TRUE(seen_from(eye, 0, targets));
  EXPECT_FALSE(seen_from(eye, 1, targets));
  WandState wand = pointing_at_first(false);
  wand.position_m = {0.0, -0.8, 0.0};
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.0, 0.69, -3.0));
  wand.room_from_wand = glm::rotation(glm::dvec3(0.0, 0.0, -1.0), direction);
  ASSERT_EQ(pick(ray_of(wand), kPickConeRad, targets), 1U);
  Selector selector;
  EXPECT_EQ(selector.update(wand, eye, targets).hovered, 0U);
  EXPECT_EQ(Selector().update(wand, {0.0, 2.0, 0.0}, targets).hovered, 1U);
}

}  // namespace selection_test
}  // namespace afm::input
