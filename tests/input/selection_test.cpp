// SPDX-License-Identifier: Apache-2.0
#include "input/selection.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace afm::input {
namespace {

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

WandState pointing_at_first(bool pressed) {
  WandState wand;
  wand.orientation_valid = true;
  if (pressed) wand.buttons = bit(WandButton::Select);
  return wand;
}

TEST(Selector, ChoosesOnceForEachPress) {
  const std::vector<Target> targets{{{0.0, 0.0, -2.0}, 0.2}};
  Selector selector;
  EXPECT_EQ(selector.update(pointing_at_first(false), targets).hovered, 0U);
  EXPECT_EQ(selector.update(pointing_at_first(true), targets).chosen, 0U);
  EXPECT_EQ(selector.update(pointing_at_first(true), targets).chosen, std::nullopt);
  EXPECT_EQ(selector.update(pointing_at_first(false), targets).chosen, std::nullopt);
  EXPECT_EQ(selector.update(pointing_at_first(true), targets).chosen, 0U);
}

TEST(Selector, ChoosesNothingWithoutAPose) {
  const std::vector<Target> targets{{{0.0, 0.0, -2.0}, 0.2}};
  Selector selector;
  WandState lost = pointing_at_first(true);
  lost.orientation_valid = false;
  const Selector::Result result = selector.update(lost, targets);
  EXPECT_EQ(result.hovered, std::nullopt);
  EXPECT_EQ(result.chosen, std::nullopt);
}

}  // namespace
}  // namespace afm::input
