// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/line_player.h"

#include <gtest/gtest.h>

#include <utility>

namespace afm::exhibit {
namespace line_player_test {

physics::ScanLine ramp(std::size_t columns) {
  physics::ScanLine line;
  line.row = 3;
  for (std::size_t i = 0; i < columns; ++i) {
    line.trace.height_m.push_back(1e-9 * static_cast<double>(i));
    line.trace.error_n.push_back(1e-12);
    line.retrace.height_m.push_back(-1e-9 * static_cast<double>(i));
    line.retrace.error_n.push_back(-1e-12);
  }
  return line;
}

TEST(LinePlayer, MovesTheTipThereAndBackInItsTime) {
  LinePlayer player;
  EXPECT_FALSE(player.playing());
  player.begin(ramp(11));
  EXPECT_TRUE(player.playing());
  EXPECT_EQ(player.row(), 3U);
  EXPECT_EQ(player.place().along, 0.0);
  player.advance(0.25 * LinePlayer::kSeconds);
  EXPECT_DOUBLE_EQ(player.place().along, 0.5);
  EXPECT_DOUBLE_EQ(player.place().height_m, 5e-9);
  EXPECT_EQ(player.place().error_n, 1e-12);
  EXPECT_FALSE(player.place().returning);
  player.advance(0.5 * LinePlayer::kSeconds);
  EXPECT_DOUBLE_EQ(player.place().along, 0.5);
  EXPECT_DOUBLE_EQ(player.place().height_m, -5e-9);
  EXPECT_EQ(player.place().error_n, -1e-12);
  EXPECT_TRUE(player.place().returning);
  player.advance(LinePlayer::kSeconds);
  EXPECT_FALSE(player.playing());
}

TEST(LinePlayer, ShowsNoErrorInMetresAsAForce) {
  physics::ScanLine tapping(ramp(4));
  tapping.trace.phase_deg.assign(4, 90.0);
  LinePlayer player;
  player.begin(std::move(tapping));
  EXPECT_EQ(player.place().error_n, 0.0);
}

TEST(LinePlayer, IsOverAtOnceWithoutPixels) {
  LinePlayer player;
  player.begin({});
  EXPECT_FALSE(player.playing());
  player.begin(ramp(1));
  EXPECT_TRUE(player.playing());
  EXPECT_EQ(player.place().height_m, 0.0);
}

}  // namespace line_player_test
}  // namespace afm::exhibit
