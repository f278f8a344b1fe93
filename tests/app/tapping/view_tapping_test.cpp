// SPDX-License-Identifier: Apache-2.0
// A lever that taps in the real window, on an X server without a screen: parameters that change, and a lesson that
// asks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "servo/replay.h"
#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace view_tapping_test {

using testing::HasSubstr;

class ViewTapping : public ::testing::Test {
 protected:
  static std::vector<std::string> window(std::vector<std::string> command) {
    command.insert(command.begin(), support::touchafm());
    command.insert(command.end(), {"--size", "640x480", "--eye-width", "320", "--frame-rate", "12", "--servo",
                                   support::servo_mode(), "--validate", "--haptics", "sim"});
    return command;
  }
  void key(const std::string& names) const {
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool key " + names);
    ASSERT_EQ(done.exit_code, 0) << done.err << " (package xdotool)";
  }

  const support::ScratchFolder folder_;
  support::VirtualDisplay display_{640, 480};
};

TEST_F(ViewTapping, FeelsParametersThatChanged) {
  support::LiveProgram view(
      window({"view", "--mode", "tapping", "--free-amplitude", "20nm", "--resonance", "300kHz", "--quality-factor",
              "400", "--spring-constant", "40N/m", "--material", "mica", "--record", folder_.file("kept")}),
      display_.name());
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  key("1");
  ASSERT_TRUE(view.says("chosen: Mica")) << view.said();
  ASSERT_TRUE(view.says("jump to the repulsive state")) << view.said();
  ASSERT_TRUE(view.says("jump to the attractive state")) << view.said();
  key("F6");
  ASSERT_TRUE(view.says("stroboscope: one swing a second")) << view.said();
  key("F");
  ASSERT_TRUE(view.says("dial of the swing: shown")) << view.said();
  key("plus plus");
  ASSERT_TRUE(view.says("parameters: 59.5 nm")) << view.said();
  ASSERT_TRUE(view.says("parameters: 70.7 nm")) << view.said();
  ASSERT_TRUE(view.says("the changed parameters are now in effect")) << view.said();
  ASSERT_TRUE(view.says("force on")) << view.said();
  ASSERT_TRUE(view.says("jump to the repulsive state")) << view.said();
  key("Escape");
  EXPECT_EQ(view.ends(), 0) << view.said();
  // the first one, too, which no other contact came before
  const auto first = servo::load_session(folder_.file("kept/session-mica.afms"));
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_NE(first->find(physics::EventKind::JumpToRepulsion), nullptr);
  EXPECT_TRUE(servo::replay(*first)->identical());
}

TEST_F(ViewTapping, IsAskedForItsStateInALesson) {
  const std::string words = "words = { en = \"Words.\", de = \"Worte.\" }\n";
  const std::string file = folder_.write(
      "lesson.toml",
      "id = \"a-lesson\"\ntitle = { en = \"A\", de = \"A\" }\nminutes = 5\nmaterials = [\"mica\"]\nscale = \"fit\"\n"
      "[tapping]\nfree_amplitude = \"20 nm\"\nspring_constant = \"40 N/m\"\nresonance = \"300 kHz\"\n"
      "quality_factor = 400\nmodel = \"dmt\"\ntip_radius = \"20 nm\"\nhamaker = \"64 zJ\"\n"
      "work_of_adhesion = \"62.4 mJ/m2\"\nreduced_modulus = \"1.5 GPa\"\n"
      "[[step]]\nid = \"name\"\ntype = \"identify\"\nof = \"states\"\nmaterial = \"mica\"\ntrials = 2\n" +
          words);
  const std::string out = folder_.file("study");
  support::LiveProgram view(window({"lesson", file, "--participant", "QXWERT", "--out", out}), display_.name());
  ASSERT_TRUE(view.says("Do you take part?")) << view.said();
  key("1");
  for (int trial = 1; trial <= 2; ++trial) {
    ASSERT_TRUE(view.says("Words.")) << view.said();
    ASSERT_TRUE(view.says("Which state was the swing in?", std::chrono::minutes(2))) << view.said();
    key("2");
  }
  ASSERT_TRUE(view.says("The lesson is finished")) << view.said();
  key("Escape");
  EXPECT_EQ(view.ends(), 0) << view.said();
  const std::string events = core::read_file(out + "/sub-QXWERT/beh/sub-QXWERT_task-alesson_events.tsv").value();
  EXPECT_THAT(events, HasSubstr("\tidentify\tn/a\t0\t1\tn/a\t"));
  EXPECT_THAT(events, HasSubstr("\trepulsive\trepulsive\t1\t"));
  EXPECT_THAT(events, HasSubstr("\tattractive\trepulsive\t0\t"));
}

}  // namespace view_tapping_test
}  // namespace afm::app
