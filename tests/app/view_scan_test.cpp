// SPDX-License-Identifier: Apache-2.0
// A scan in the real window, on an X server without a screen, operated only by keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/pictures.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace view_scan_test {

class ViewScan : public ::testing::Test {
 protected:
  std::vector<std::string> view() const {
    return {"/usr/bin/env",
            "-C",
            folder_.path(),
            support::touchafm(),
            "view",
            "--size",
            "320x240",
            "--eye-width",
            "320",
            "--stereo",
            "mono",
            "--frame-rate",
            "10",
            "--record",
            "kept",
            "--wand",
            "mouse",
            "--servo",
            support::servo_mode(),
            "--material",
            "gold"};
  }
  void xdotool(const std::string& what) const {
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool " + what);
    ASSERT_EQ(done.exit_code, 0) << "xdotool " << what << ": " << done.err << " (package xdotool)";
  }
  // Turn-On is pressed until the force comes: a press before the hand is up, or still, is none.
  bool turn_on(support::LiveProgram& program) const {
    for (int presses = 0; presses < 40; ++presses) {
      xdotool("key t");
      if (program.says("force on", std::chrono::seconds(2))) return true;
    }
    return false;
  }
  void lift_hand() const { xdotool("mousemove 160 120 mousedown 3 mousemove 160 90 mouseup 3"); }

  // Waits until the tip of the scanning hand lies on the sample. Where a tick came late, as on a busy machine, the
  // servo has let go: then the scan ends, the hand lifts and begins it again, as the wall says.
  bool hand_takes_the_image(support::LiveProgram& program) const {
    for (int faults = 0; faults < 10; ++faults) {
      const std::string said = program.says_one_of({"Your hand takes the image", "force off"});
      if (said != "force off") return !said.empty();
      xdotool("key l");
      if (!program.says("scan: the tip scans alone")) return false;
      lift_hand();
      if (!turn_on(program)) return false;
      xdotool("key l key l");
      if (!program.says("scan: the hand takes the image")) return false;
    }
    return false;
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{320, 240};
};

TEST_F(ViewScan, TakesAnImageAndNamesAnArtefact) {
  support::LiveProgram program(view(), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  xdotool("mousemove 160 10 key i");
  ASSERT_TRUE(program.says("scan: choose a sample first")) << program.said();
  xdotool("key 1");
  ASSERT_TRUE(program.says("Press Turn-On")) << program.said();
  xdotool("key i");
  ASSERT_TRUE(program.says("scan: Gold, 265 nm wide, 128 lines")) << program.said();
  ASSERT_TRUE(program.says("Scanning: Tab chooses a setting")) << program.said();
  xdotool("key Tab key Tab key plus");
  ASSERT_TRUE(program.says("scan: 2 nN, 5000/s, 10 Hz, 50 nm")) << program.said();
  ASSERT_TRUE(program.says("Ringing: the gain is too high")) << program.said();
  xdotool("key minus");
  ASSERT_TRUE(program.says("scan: 2 nN, 2000/s, 10 Hz, 50 nm")) << program.said();
  xdotool("key i");
  ASSERT_TRUE(program.says("scan: ended")) << program.said();
  xdotool("key Escape");
  EXPECT_EQ(program.ends(), 0) << program.said();
}

TEST_F(ViewScan, IsDrawnAgainFromItsSession) {
  support::LiveProgram program(view(), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  xdotool("mousemove 160 10 key 1");
  ASSERT_TRUE(program.says("chosen: Gold")) << program.said();
  lift_hand();
  ASSERT_TRUE(turn_on(program)) << program.said();
  xdotool("key e");
  ASSERT_TRUE(program.says("sample: heights in false colours")) << program.said();
  xdotool("key i");
  ASSERT_TRUE(program.says("scan: Gold")) << program.said();
  // a line a second: the tip is where it was when the picture is drawn from the last frame of a slow machine
  xdotool("key Tab key Tab key Tab key minus key minus key minus");
  ASSERT_TRUE(program.says("1 Hz, 50 nm")) << program.said();
  xdotool("key u");
  ASSERT_TRUE(program.says("scan: showing what the tip could not reach")) << program.said();
  xdotool("key F12");
  ASSERT_TRUE(program.says("saved ./touchafm-001.png")) << program.said();
  xdotool("key Escape");
  ASSERT_EQ(program.ends(), 0) << program.said();

  const auto session = servo::load_session(folder_.file("kept/session-gold.afms"));
  ASSERT_TRUE(session) << program.said() << session.error().message;
  ASSERT_FALSE(session->wall.empty());
  ASSERT_TRUE(session->wall.back().scan.has_value());
  EXPECT_TRUE(session->wall.back().scan->truth);
  EXPECT_FALSE(session->wall.front().scan.has_value());
  EXPECT_TRUE(session->wall.back().false_colours);
  EXPECT_FALSE(session->wall.front().false_colours);
  const double end_s =
      session->seconds_since_start(std::min(session->wall.back().time_ns, session->samples.back().time_ns));
  const auto draw = [&](double at_s, const std::string& name) {
    const std::string command = support::touchafm() + " render --session " + folder_.file("kept/session-gold.afms") +
                                " --at " + std::to_string(at_s) + " --size 320x240 --out " + folder_.file(name);
    const auto drawn = support::run_program(command);
    EXPECT_EQ(drawn.exit_code, 0) << command << ": " << drawn.err;
    return test::read_png(folder_.file(name));
  };
  const render::Image saved = test::read_png(folder_.file("touchafm-001.png"));
  EXPECT_LT(test::difference(saved, draw(end_s, "end.png"), 24).share_beyond, 0.06);
  EXPECT_GT(test::difference(saved, draw(0.0, "begin.png"), 24).share_beyond, 0.08);  // no scan yet
}

// The mouse lowers the tip, and a drag goes over the sample.
TEST_F(ViewScan, IsTakenByTheHandAndDrawnAgain) {
  support::LiveProgram program(view(), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  xdotool("mousemove 160 10 key 1");
  ASSERT_TRUE(program.says("chosen: Gold")) << program.said();
  lift_hand();
  ASSERT_TRUE(turn_on(program)) << program.said();
  xdotool("key k");
  ASSERT_TRUE(program.says("scan: press L first")) << program.said();
  xdotool("key l");
  ASSERT_TRUE(program.says("scan: the tip leads the hand")) << program.said();
  EXPECT_FALSE(program.says_one_of({"Hold Turn-On: the tip leads", "press and hold Turn-On"}).empty());
  xdotool("key l");
  ASSERT_TRUE(program.says("scan: the hand takes the image")) << program.said();
  ASSERT_TRUE(program.says("scan: ended")) << program.said();  // end of the lead from the servo
  ASSERT_TRUE(hand_takes_the_image(program)) << program.said();
  xdotool("mousemove 160 120 mousedown 3");
  for (const char* place : {"200 120", "120 115", "200 110", "120 105", "200 125", "120 130", "200 135"}) {
    xdotool(std::string("mousemove ") + place + " sleep 1");
  }
  xdotool("mouseup 3 sleep 2 key F12");  // a slow machine, too, saves and records a hand at rest
  ASSERT_TRUE(program.says("saved ./touchafm-001.png")) << program.said();
  xdotool("key k");
  ASSERT_TRUE(program.says("scan: feedback off")) << program.said();
  xdotool("key l");
  ASSERT_TRUE(program.says("scan: the tip scans alone")) << program.said();
  xdotool("key Escape");
  ASSERT_EQ(program.ends(), 0) << program.said();

  const auto session = servo::load_session(folder_.file("kept/session-gold.afms"));
  ASSERT_TRUE(session) << program.said() << session.error().message;
  const auto painted = [](const servo::WallFrame& f) {
    return f.scan_hand && f.scan_hand->paints && f.scan_hand->feedback;
  };
  const auto last = std::find_if(session->wall.rbegin(), session->wall.rend(), painted);
  ASSERT_NE(last, session->wall.rend());
  const auto draw = [&](const std::string& at_s, const std::string& name) {
    const std::string command = support::touchafm() + " render --session " + folder_.file("kept/session-gold.afms") +
                                " --at " + at_s + " --size 320x240 --out " + folder_.file(name);
    const auto drawn = support::run_program(command);
    EXPECT_EQ(drawn.exit_code, 0) << command << ": " << drawn.err;
    return test::read_png(folder_.file(name));
  };
  const render::Image saved = test::read_png(folder_.file("touchafm-001.png"));
  const double end_s = session->seconds_since_start(last->time_ns);
  EXPECT_LT(test::difference(saved, draw(std::to_string(end_s), "end.png"), 24).share_beyond, 0.03);
  const auto replayed = support::run_program(support::touchafm() + " replay " + folder_.file("kept/session-gold.afms"));
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_THAT(replayed.out, testing::HasSubstr("is identical, bit for bit"));
}

}  // namespace view_scan_test
}  // namespace afm::app
