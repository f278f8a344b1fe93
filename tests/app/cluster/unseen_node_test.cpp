// SPDX-License-Identifier: Apache-2.0
// A wall whose sample is shown by another machine than the one with the hand.
#include <gmock/gmock.h>
#include <signal.h>

#include "app/cluster/cluster_wall.h"
#include "core/clock.h"
#include "support/dark_after.h"
#include "support/stall_watch.h"

namespace afm::app {
namespace unseen_node_test {

using namespace std::chrono_literals;

constexpr support::Milliseconds kMostDark{350.0};

// The hand's machine shows the screen at the left; the stage is on the screen in front, which node "left" shows.
constexpr const char* kWall = R"(
[[screen]]
name = "front"
lower_left = [-1.524, 0.400, 0.0]
lower_right = [1.524, 0.400, 0.0]
upper_left = [-1.524, 2.686, 0.0]
[[screen]]
name = "side"
lower_left = [-1.524, 0.400, 3.0]
lower_right = [-1.524, 0.400, 0.0]
upper_left = [-1.524, 2.686, 3.0]
[[node]]
name = "left"
host = "127.0.0.1"
[[viewer]]
name = "visitor"
ipd = "63 mm"
sweet_spot = [0.0, 1.65, 2.5]
[[output]]
name = "output 0"
screen = "side"
mode = "anaglyph-red-cyan"
rect = [0, 0, 160, 120]
[[output]]
name = "output 1"
screen = "front"
node = "left"
mode = "anaglyph-red-cyan"
rect = [160, 0, 160, 120]
)";

class UnseenNode : public ClusterWall {
 protected:
  UnseenNode() { folder_.write("wall.toml", kWall); }

  std::string kept() const { return folder_.file("kept-" + std::to_string(runs_)); }

  // Kills the node under force, and returns when. Where a tick that came late has ended the force before, as on a busy
  // machine, the node comes back, the force is switched on again, and the node is killed once more.
  std::int64_t lost_under_force(std::unique_ptr<support::LiveProgram>& left, support::LiveProgram& hand) const {
    for (int attempt = 0; attempt < 3; ++attempt) {
      left->signal(SIGKILL);
      const std::int64_t lost_ns = core::MonotonicClock().now_ns();
      EXPECT_TRUE(hand.says("the machine that shows the sample is missing")) << hand.said();
      if (hand.says("force off: nobody sees the picture", 5s)) return lost_ns;
      left = start(node_command("left", "127.0.0.1"));
      EXPECT_TRUE(hand.says("the picture is seen again")) << hand.said();
      press_at_master("1");
      EXPECT_TRUE(hand.says("force on")) << hand.said();
    }
    ADD_FAILURE() << "the force was never on when the node went missing: " << hand.said();
    return 0;
  }

  int runs_ = 0;
};

TEST_F(UnseenNode, ThatIsMissingLosesTheForceUntilItIsBack) {
  support::expect_within(kMostDark, [&] {
    const support::StallWatch watch;
    ++runs_;
    auto left = start(node_command("left", "127.0.0.1"));
    std::vector<std::string> command = master_command();
    command.insert(command.end(), {"--haptics", "sim", "--material", "mica", "--record", kept()});
    const auto hand = start(command);
    EXPECT_TRUE(hand->says("node left shows the wall")) << hand->said();
    press_at_master("1");
    EXPECT_TRUE(hand->says("force on")) << hand->said();
    const std::int64_t lost_ns = lost_under_force(left, *hand);
    hand->skip_what_it_said();
    EXPECT_FALSE(hand->says("force on", 2s)) << hand->said();
    left = start(node_command("left", "127.0.0.1"));
    EXPECT_TRUE(hand->says("the picture is seen again")) << hand->said();
    EXPECT_TRUE(hand->says("force on")) << hand->said();
    hand->signal(SIGINT);
    EXPECT_EQ(hand->ends(), 0) << hand->said();
    return support::dark_after(lost_ns, kept() + "/session-mica.afms", watch);
  });
}

}  // namespace unseen_node_test
}  // namespace afm::app
