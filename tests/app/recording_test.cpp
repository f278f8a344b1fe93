// SPDX-License-Identifier: Apache-2.0
// Invariant: a killed program loses at most a second of its session; the frames of a session can be drawn again
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include "core/clock.h"
#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/pictures.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

// Result of `touchafm view --record`, however the window ends.
namespace afm::app {
namespace recording_test {

using ::testing::HasSubstr;
using namespace std::chrono_literals;

class RecordingTest : public ::testing::Test {
 protected:
  std::vector<std::string> view(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"/usr/bin/env",
                                 "-C",
                                 folder_.path(),
                                 support::touchafm(),
                                 "view",
                                 "--size",
                                 "320x240",
                                 "--eye-width",
                                 "320",
                                 "--frame-rate",
                                 "10",
                                 "--record",
                                 "kept",
                                 "--servo",
                                 support::servo_mode(),
                                 "--material",
                                 "gold"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void xdotool(const std::string& what) const {
    ASSERT_EQ(support::run_program("DISPLAY=" + display_.name() + " xdotool " + what).exit_code, 0) << what;
  }
  std::string kept() const { return folder_.file("kept/session-gold.afms"); }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{320, 240};
};

TEST_F(RecordingTest, OfAKilledProgramLacksTheLastSecondAtMostAndReplays) {
  support::LiveProgram program(view({"--haptics", "sim", "--linger", "0"}), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  xdotool("mousemove 160 10 key 1");
  ASSERT_TRUE(program.says("jump to contact")) << program.said();
  std::this_thread::sleep_for(700ms);  // in contact, with force
  const std::int64_t killed_ns = core::MonotonicClock().now_ns();
  program.signal(SIGKILL);
  program.ends();

  const auto session = servo::load_session(kept());
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_FALSE(session->complete);
  // twice the second that docs/manual/demonstrate.md promises, for a machine that stalls
  EXPECT_LT(static_cast<double>(killed_ns - session->samples.back().time_ns) * 1e-9, 2.0);
  const auto replayed = support::run_program(support::touchafm() + " replay " + kept());
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_THAT(replayed.err, HasSubstr("truncated after"));
  EXPECT_THAT(replayed.out, HasSubstr("jump-to-contact"));
  EXPECT_THAT(replayed.out, HasSubstr("is identical, bit for bit"));
}

TEST_F(RecordingTest, DrawsTheFrameThatWasOnTheWall) {
  support::LiveProgram program(view({"--stereo", "mono"}), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  xdotool("mousemove 160 10 key 1");
  ASSERT_TRUE(program.says("chosen: Gold")) << program.said();
  xdotool("mousemove 160 120 mousedown 3 mousemove 160 90 mouseup 3");
  for (int presses = 0; presses < 40 && !program.says("force on", 2s); ++presses) xdotool("key t");
  xdotool("key a");
  ASSERT_TRUE(program.says("showing Millet's analogy")) << program.said();
  xdotool("key F2");
  std::this_thread::sleep_for(1s);
  xdotool("key F12");
  ASSERT_TRUE(program.says("saved ./touchafm-001.png")) << program.said();
  xdotool("key Escape");
  ASSERT_EQ(program.ends(), 0) << program.said();

  const auto session = servo::load_session(kept());
  ASSERT_TRUE(session) << program.said() << session.error().message;
  EXPECT_TRUE(session->complete);
  EXPECT_THAT(session->sources, HasSubstr("\"source\":\"Liu & Peng, Table 1\""));
  ASSERT_FALSE(session->wall.empty());
  const auto draw = [&](double at_s, const std::string& name) {
    const std::string command = support::touchafm() + " render --session " + kept() + " --at " + std::to_string(at_s) +
                                " --size 320x240 --out " + folder_.file(name);
    const auto drawn = support::run_program(command);
    EXPECT_EQ(drawn.exit_code, 0) << command << ": " << drawn.err;
    return test::read_png(folder_.file(name));
  };
  const render::Image saved = test::read_png(folder_.file("touchafm-001.png"));
  // the newest frame may show a tick that was no longer recorded
  const double end_s =
      session->seconds_since_start(std::min(session->wall.back().time_ns, session->samples.back().time_ns));
  // the servo's figures and the depth meter's differ
  EXPECT_LT(test::difference(saved, draw(end_s, "end.png"), 24).share_beyond, 0.04);
  EXPECT_GT(test::difference(saved, draw(0.0, "begin.png"), 24).share_beyond, 0.15);  // instrument without a panel
}

}  // namespace recording_test
}  // namespace afm::app
