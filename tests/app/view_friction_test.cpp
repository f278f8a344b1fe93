// SPDX-License-Identifier: Apache-2.0
// The friction loop next to the force curve in the real window, on an X server without a screen, operated only by keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace view_friction_test {

class ViewFriction : public ::testing::Test {
 protected:
  std::vector<std::string> view(const std::string& friction) const {
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
            "mica",
            "--haptics",
            "sim",
            "--friction",
            friction};
  }
  void xdotool(const std::string& what) const {
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool " + what);
    ASSERT_EQ(done.exit_code, 0) << "xdotool " << what << ": " << done.err << " (package xdotool)";
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{320, 240};
};

TEST_F(ViewFriction, SaysHowToTurnFrictionOn) {
  support::LiveProgram program(view("none"), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  xdotool("mousemove 160 10 key f");
  ASSERT_TRUE(program.says("friction loop: choose a sample first")) << program.said();
  xdotool("key 1");
  ASSERT_TRUE(program.says("chosen: Mica")) << program.said();
  ASSERT_TRUE(program.says("force on")) << program.said();
  xdotool("key f");
  ASSERT_TRUE(program.says("friction loop: friction is off; start with --friction lattice")) << program.said();
  xdotool("key f");
  ASSERT_TRUE(program.says("friction loop: hidden")) << program.said();
  xdotool("key Escape");
  EXPECT_EQ(program.ends(), 0) << program.said();
}

TEST_F(ViewFriction, IsInTheSessionSoThatItIsDrawnAgain) {
  support::LiveProgram program(view("lattice"), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  xdotool("mousemove 160 10 key 1");
  ASSERT_TRUE(program.says("force on")) << program.said();
  xdotool("key f");
  ASSERT_TRUE(program.says("friction loop: shown, friction lattice")) << program.said();
  ASSERT_TRUE(program.says("jump to contact")) << program.said();
  xdotool("key F2");
  xdotool("key f");
  ASSERT_TRUE(program.says("friction loop: shown")) << "F2 takes its place: " << program.said();
  ASSERT_TRUE(program.says("jump off contact")) << program.said();
  xdotool("key Escape");
  ASSERT_EQ(program.ends(), 0) << program.said();

  const auto session = servo::load_session(folder_.file("kept/session-mica.afms"));
  ASSERT_TRUE(session) << program.said() << session.error().message;
  const auto shown = [&](const char* panels) {
    return std::any_of(session->wall.begin(), session->wall.end(), [&](const auto& f) { return f.panels == panels; });
  };
  EXPECT_TRUE(shown("friction-loop"));
  ASSERT_FALSE(session->wall.empty());
  EXPECT_EQ(session->wall.back().panels, "friction-loop");
}

}  // namespace view_friction_test
}  // namespace afm::app
