// SPDX-License-Identifier: Apache-2.0
// Outages that last longer than DDS remembers a machine, and a node that is started again and again.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "app/cluster_cable.h"

namespace afm::app {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::Not;

class ClusterOutage : public ClusterCable {
 protected:
  std::unique_ptr<support::LiveProgram> begin() {
    std::vector<std::string> command = master_command();
    command.insert(command.end(), {"--haptics", "sim"});
    auto hand = start(network_.on(0, command));
    expect_both_shown(*hand);
    return hand;
  }
};

TEST_F(ClusterOutage, LongerThanTheLeaseOfDdsEndsWithinTwiceTwoSeconds) {
  const auto left = node("left", 1);
  const auto right = node("right", 2);
  const auto hand = begin();
  press_at_master("1");
  ASSERT_TRUE(hand->says("force on")) << hand->said();
  for (const int out_s : {14, 40}) {
    network_.pull_cable(1);
    ASSERT_TRUE(hand->says("node left is missing")) << hand->said();
    std::this_thread::sleep_for(seconds(out_s));
    network_.plug_cable(1);
    ASSERT_TRUE(hand->says("node left shows the wall", seconds(4))) << out_s << " s: " << hand->said();
  }
  EXPECT_THAT(hand->said(), Not(HasSubstr("the renderer gave no frame")));
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0);
  EXPECT_THAT(hand->said(), Not(HasSubstr("built frame")));
}

TEST_F(ClusterOutage, ANodeThatComesThirtySecondsLateBuildsTheSameFrames) {
  const auto left = node("left", 1);
  std::vector<std::string> command = master_command();
  command.insert(command.end(), {"--haptics", "sim"});
  const auto hand = start(network_.on(0, command));
  ASSERT_TRUE(hand->says("node left shows the wall")) << hand->said();
  press_at_master("1");
  ASSERT_TRUE(hand->says("force on")) << hand->said();
  std::this_thread::sleep_for(seconds(30));
  const auto right = node("right", 2);
  ASSERT_TRUE(hand->says("node right shows the wall")) << hand->said();
  ASSERT_TRUE(hand->says("jump to contact")) << hand->said();
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0);
  EXPECT_THAT(hand->said(), Not(HasSubstr("built frame")));
}

TEST_F(ClusterOutage, TwentyRestartsOfANodeEachShowTheWallAgain) {
  auto left = node("left", 1);
  const auto right = node("right", 2);
  const auto hand = begin();
  for (int i = 0; i < 20; ++i) {
    left->signal(SIGKILL);
    left->ends();
    ASSERT_TRUE(hand->says("node left is missing")) << i << hand->said();
    left = node("left", 1);
    ASSERT_TRUE(hand->says("node left shows the wall")) << i << hand->said();
  }
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0);
  EXPECT_THAT(hand->said(), Not(HasSubstr("built frame")));
}

}  // namespace
}  // namespace afm::app
