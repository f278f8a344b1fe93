// SPDX-License-Identifier: Apache-2.0
// The real window without a tracker and without staff, on an X server without a screen.
// Invariant: a visitor's first press takes effect
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace view_alone_test {

using ::testing::HasSubstr;
using ::testing::Not;

class ViewAlone : public ::testing::Test {
 protected:
  std::vector<std::string> view(std::vector<std::string> more) const {
    std::vector<std::string> all{
        support::touchafm(),   "view",   "--size", "320x180", "--frame-rate", "12", "--eye-width", "160", "--servo",
        support::servo_mode(), "--wand", "mouse"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void xdotool(const std::string& what) const {
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool " + what);
    ASSERT_EQ(done.exit_code, 0) << "xdotool " << what << ": " << done.err << " (package xdotool)";
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{320, 180};
};

TEST_F(ViewAlone, ArrowKeysMoveAHeadAndTheFrameLogFollowsIt) {
  const std::string log = folder_.file("frames.csv");
  support::LiveProgram program(view({"--stereo", "anaglyph-red-cyan", "--frame-log", log}), display_.name());
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  xdotool("key Right");
  ASSERT_TRUE(program.says("head: +0.05 m to the right")) << program.said();
  xdotool("key Next");
  ASSERT_TRUE(program.says("-0.05 m nearer")) << program.said();
  ASSERT_TRUE(program.says("depth ")) << program.said();
  xdotool("key Escape");
  ASSERT_EQ(program.ends(), 0) << program.said();
  EXPECT_THAT(program.said(), HasSubstr("head: latency from packet to presented frame"));
  const std::string text = core::read_file(log).value();
  EXPECT_THAT(text, HasSubstr("frame,time_s,drawn_ms,interval_ms,head_latency_ms,nearest_deg,"));
  // three rows at least, for two keys and the answer; how many more is the speed of the machine
  EXPECT_GE(std::count(text.begin(), text.end(), '\n'), 4);
}

TEST_F(ViewAlone, FollowsAScriptOfTheHead) {
  const std::string script = folder_.write("head.csv", "0, 0, 1.65, 2.5\n1, 0.4, 1.65, 2.5\n2, 0, 1.65, 2.5\n");
  support::LiveProgram program(view({"--head", "sim:" + script}), display_.name());
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  xdotool("key Escape");
  ASSERT_EQ(program.ends(), 0) << program.said();
  EXPECT_THAT(program.said(), HasSubstr("head: latency from packet to presented frame"));
  EXPECT_THAT(program.said(), Not(HasSubstr("impossible position")));
}

TEST_F(ViewAlone, AnUnattendedWindowStaysShowsItselfAndMakesWay) {
  support::LiveProgram program(view({"--kiosk", "--idle", "5"}), display_.name());
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  xdotool("key Escape key s key F12");
  ASSERT_TRUE(program.says("no visitor: the wall demonstrates itself")) << program.said();
  ASSERT_TRUE(program.says("chosen: Mica")) << program.said();
  xdotool("mousemove 30 40");
  ASSERT_TRUE(program.says("a visitor has arrived")) << program.said();
  EXPECT_THAT(program.said(), Not(HasSubstr("eyes swapped")));
  EXPECT_THAT(program.said(), Not(HasSubstr("saved ")));
  program.signal(SIGTERM);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

// The visitor's first press acts on the wall as they found it, whatever the demonstration was doing.
TEST_F(ViewAlone, AVisitorGetsTheSampleOfTheirFirstPress) {
  support::LiveProgram program(view({"--unattended", "--idle", "5"}), display_.name());
  for (const char* sample : {"Gold", "Silicon nitride", "Gold"}) {
    ASSERT_TRUE(program.says("no visitor: the wall demonstrates itself")) << program.said();
    ASSERT_TRUE(program.says("chosen: ")) << program.said();
    ASSERT_TRUE(program.says("force on")) << program.said();
    const std::string key = sample == std::string("Gold") ? "2" : "3";
    xdotool("key " + key);
    ASSERT_TRUE(program.says("a visitor has arrived")) << program.said();
    ASSERT_TRUE(program.says("chosen: " + std::string(sample))) << program.said();
    // the demonstration's force is off, and the wall's next texts are about the chosen sample
    ASSERT_TRUE(program.says("force off")) << program.said();
    ASSERT_EQ(program.says_one_of({"Press Turn-On", "force on"}), "Press Turn-On") << program.said();
  }
  program.signal(SIGTERM);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

// The picture's scale is not the hand's on the way, although the sample stays the same.
TEST_F(ViewAlone, TheJourneyOfScaleTakesTheForceAway) {
  support::LiveProgram program(view({"--haptics", "sim"}), display_.name());
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  xdotool("key 1");
  ASSERT_TRUE(program.says("force on")) << program.said();
  xdotool("key j");
  ASSERT_TRUE(program.says("the journey of scale was reversed")) << program.said();
  EXPECT_EQ(program.says_one_of({"force off", "jump to contact", "jump off contact"}), "force off") << program.said();
  program.signal(SIGTERM);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

// The window of a kiosk: its child that draws.
pid_t window_of(pid_t kiosk) {
  const auto children =
      core::read_file("/proc/" + std::to_string(kiosk) + "/task/" + std::to_string(kiosk) + "/children");
  return children && !children->empty() ? std::stoi(*children) : -1;
}

TEST_F(ViewAlone, AKioskReopensAWindowThatHangsAndEndsOneOnRequest) {
  support::LiveProgram program(view({"--kiosk"}), display_.name());
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  const pid_t first = window_of(program.pid());
  ASSERT_GT(first, 0);
  ::kill(first, SIGSTOP);
  ASSERT_TRUE(program.says("the window hung: no frame for 10 s; reopening it")) << program.said();
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  const pid_t second = window_of(program.pid());
  EXPECT_NE(second, first);
  ::kill(second, SIGSTOP);
  program.signal(SIGTERM);
  EXPECT_EQ(program.ends(), 1);
  EXPECT_THAT(program.said(), HasSubstr("the window did not end within 8 s and was killed"));
  EXPECT_NE(::kill(second, 0), 0);
}

}  // namespace view_alone_test
}  // namespace afm::app
