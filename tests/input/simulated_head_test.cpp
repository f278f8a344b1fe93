// SPDX-License-Identifier: Apache-2.0
#include "input/simulated_head.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/scratch_folder.h"

namespace afm::input {
namespace simulated_head_test {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000'000;
const scene::HeadPose kStart{.position_m = {0.0, 1.65, 2.5}};

core::Result<std::vector<HeadKey>> load(const std::string& text) {
  const support::ScratchFolder folder;
  return load_head_script(folder.write("head.csv", text));
}

TEST(SimulatedHead, StaysAwayUntilAStepAndThenWalks) {
  SimulatedHead head(kStart, {});
  EXPECT_FALSE(head.pose(kSecond));
  head.step({0.3, 0.0, 0.0});
  EXPECT_EQ(head.pose(kSecond)->position_m, kStart.position_m);
  const double half_way = head.pose(kSecond + kSecond / 4)->position_m.x;
  EXPECT_NEAR(half_way, 0.25 * SimulatedHead::kPaceMPerS, 1e-12);
  EXPECT_NEAR(head.pose(3 * kSecond)->position_m.x, 0.3, 1e-12);
  head.step({0.0, 0.1, 0.0});
  head.step({0.0, 0.1, 0.0});
  head.pose(3 * kSecond);
  EXPECT_NEAR(head.pose(5 * kSecond)->position_m.y, 1.85, 1e-12) << "steps add up";
  head.home();
  EXPECT_LT(glm::distance(head.pose(9 * kSecond)->position_m, kStart.position_m), 1e-12);
}

TEST(SimulatedHead, FollowsItsScriptOverAndOverUntilAStep) {
  const auto script = load("# seconds, x, y, z\n0, 0, 1.6, 2\n2, 1, 1.6, 2   # to the right\n4, 0, 1.6, 2\n");
  ASSERT_TRUE(script) << script.error().message;
  SimulatedHead head(kStart, *script);
  EXPECT_NEAR(head.pose(10 * kSecond)->position_m.x, 0.0, 1e-12);
  EXPECT_NEAR(head.pose(11 * kSecond)->position_m.x, 0.5, 1e-12);
  EXPECT_NEAR(head.pose(13 * kSecond)->position_m.x, 0.5, 1e-12);
  EXPECT_NEAR(head.pose(15 * kSecond)->position_m.x, 0.5, 1e-12) << "again";
  head.step({0.0, 0.2, 0.0});
  EXPECT_NEAR(head.pose(20 * kSecond)->position_m.x, 0.5, 1e-12);
  EXPECT_NEAR(head.pose(21 * kSecond)->position_m.y, 1.8, 1e-12);
}

TEST(SimulatedHead, TurnsAsItsScriptSays) {
  const auto script = load("0 0 1.6 2 0 0 0 1\n1 0 1.6 2 0 0.70710678 0 0.70710678\n");
  ASSERT_TRUE(script) << script.error().message;
  SimulatedHead head(kStart, *script);
  head.pose(kSecond);
  const glm::dvec3 right = head.pose(kSecond + kSecond / 2)->room_from_head * glm::dvec3(1.0, 0.0, 0.0);
  EXPECT_NEAR(right.x, std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(right.z, -std::sqrt(0.5), 1e-6);
}

TEST(HeadScript, IsRefusedWithFileAndLine) {
  const std::pair<const char*, const char*> wrong[] = {
      {"0, 0, 1.6, 2\n1, x, 1.6, 2\n", "line 2: contains a value that is not a number"},
      {"0, 0, 1.6\n", "line 1: must be seconds, x, y, z"},
      {"1, 0, 1.6, 2\n", "line 1: times must rise from 0"},
      {"0, 0, 1.6, 2\n0, 0, 1.6, 2\n", "line 2: times must rise"},
      {"0, 0, 1600, 2000\n", "line 1: the head must be within 100 m"},
      {"0 0 1 2 0 0 0 2\n", "unit quaternion"},
      {"0, nan, 1, 2\n", "not a number"},
      {"# nothing\n", "at least two positions"},
  };
  for (const auto& [text, message] : wrong) {
    const auto script = load(text);
    ASSERT_FALSE(script) << text;
    EXPECT_EQ(script.error().category, core::ErrorCategory::BadInputFile);
    EXPECT_THAT(script.error().message, HasSubstr(message)) << text;
  }
  EXPECT_EQ(load_head_script("/nowhere/head.csv").error().category, core::ErrorCategory::BadInputFile);
}

}  // namespace simulated_head_test
}  // namespace afm::input
