// SPDX-License-Identifier: Apache-2.0
// Invariant: a push is undone bit for bit, and only without a force
#include "haptics/stroke_history.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace afm::haptics {
namespace stroke_history_test {

using Poses = std::vector<scene::ParticlePose>;

scene::ParticlePose pose_at(double x_m) { return {.x_m = x_m, .moved = physics::PushState::Rolls}; }

// True if there was a stroke to take back.
bool take_back(StrokeHistory& history, Poses& poses) {
  return history.take_back([&](std::uint32_t i, const scene::ParticlePose& before) { poses[i] = before; });
}

TEST(StrokeHistory, HasNoneAtFirstAndKeepsNoneThatMovesNothing) {
  StrokeHistory history(3);
  Poses poses(3);
  EXPECT_FALSE(take_back(history, poses));
  history.begin();
  history.begin();
  EXPECT_EQ(history.size(), 0U);
  EXPECT_FALSE(take_back(history, poses));
}

// Random strokes over few and many particles, with some taken back at once: what is given back is what a full copy of
// the poses before each stroke has.
TEST(StrokeHistory, GivesBackThePosesBeforeEachOfTheNewestStrokes) {
  std::mt19937_64 random(36);
  for (const std::size_t count : {1U, 5U, 40U, 700U}) {
    StrokeHistory history(count);
    Poses poses(count);
    std::vector<Poses> before;
    double next_m = 0.0;
    const auto take_one_back = [&] {
      ASSERT_TRUE(take_back(history, poses));
      ASSERT_EQ(poses, before.back());
      before.pop_back();
    };
    for (int stroke = 0; stroke < 500; ++stroke) {
      history.begin();
      before.push_back(poses);
      const std::size_t moves = 1 + random() % (2 * count);
      for (std::size_t n = 0; n < moves; ++n) {
        const auto i = static_cast<std::uint32_t>(random() % count);
        history.keep(i, poses[i]);
        poses[i] = pose_at(next_m += 1.0);
      }
      ASSERT_GE(history.size(), 1U);
      ASSERT_LE(history.size(), scene::kMostStrokes);
      if (random() % 4 == 0) take_one_back();
    }
    if (count <= 16) EXPECT_EQ(history.size(), scene::kMostStrokes) << count;
    while (history.size() > 0) take_one_back();
    EXPECT_FALSE(take_back(history, poses));
  }
}

}  // namespace stroke_history_test
}  // namespace afm::haptics
