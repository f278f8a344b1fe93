// SPDX-License-Identifier: Apache-2.0
// The instructor's window on the second monitor of a real X server, beside a lesson on the first one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "core/whole_file.h"
#include "exhibit/lesson/instructor_page.h"
#include "render/image_file.h"
#include "support/live_program.h"
#include "support/phrases.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/two_monitors.h"

namespace afm::app {
namespace instructor_test {

using exhibit::InstructorAction;
using support::TwoMonitors;
using ::testing::HasSubstr;
using ::testing::Not;

class InstructorTest : public ::testing::Test {
 protected:
  std::vector<std::string> command(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{
        support::touchafm(), "lesson", file_,     "--monitor",           "DUMMY0",    "--instructor", "DUMMY1",
        "--frame-rate",      "12",     "--servo", support::servo_mode(), "--haptics", "sim",          "--validate",
        "--language",        "en"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  support::ProgramResult xdotool(const std::string& arguments) const {
    return support::run_program("env -u WAYLAND_DISPLAY DISPLAY=" + monitors_.name() + " xdotool " + arguments);
  }
  // A click on the target on the second monitor.
  void click(InstructorAction action) const {
    constexpr double kAspect = static_cast<double>(TwoMonitors::kWidth) / TwoMonitors::kHeight;
    exhibit::InstructorState state;
    state.prompt.in_step = true;
    const auto frame = exhibit::InstructorPage(kAspect).frame(state, std::nullopt, test::english());
    const render::PanelPlacement& target = frame.labels.at(core::index_of(action)).placement;
    const glm::dvec3 middle_m = target.lower_left_m + 0.5 * (target.right_m + target.up_m);
    const auto x = std::lround(TwoMonitors::kWidth * (1.5 + middle_m.x / kAspect));
    const auto y = std::lround(TwoMonitors::kHeight * (1.0 - middle_m.y));
    ASSERT_EQ(xdotool("mousemove " + std::to_string(x) + " " + std::to_string(y) + " click 1").exit_code, 0);
  }
  void key(const std::string& name) const {
    ASSERT_EQ(xdotool("search --name 'TouchAFM, instructor' windowfocus key " + name).exit_code, 0);
  }
  // Kept in the build tree for people to look at.
  void picture(const std::string& name) const {
    EXPECT_TRUE(render::write_png(monitors_.screenshot(), support::built("instructor-") + name + ".png"));
  }

  const support::ScratchFolder folder_;
  const std::string file_ = folder_.write(
      "lesson.toml",
      "id = \"a-lesson\"\ntitle = { en = \"A lesson\", de = \"Lektion\" }\nminutes = 5\nmaterials = [\"mica\"]\n"
      "scale = \"fit\"\n"
      "[[step]]\nid = \"hello\"\ntype = \"text\"\nwords = { en = \"Words of hello.\", de = \"Worte.\" }\n"
      "[[step]]\nid = \"feel\"\ntype = \"cycle\"\nmaterial = \"mica\"\ntrials = 50\n"
      "words = { en = \"Words of feel.\", de = \"Worte.\" }\n"
      "[[step]]\nid = \"ask\"\ntype = \"question\"\nquestionnaire = \"tlx\"\n"
      "words = { en = \"Words of ask.\", de = \"Worte.\" }\n");
  TwoMonitors monitors_;
};

TEST_F(InstructorTest, GoesOnTakesTheForceAwaySkipsAndStopsFromTheSecondMonitor) {
  const std::string out = folder_.file("study");
  support::LiveProgram view(command({"--participant", "QXWERT", "--out", out}), monitors_.name());
  ASSERT_TRUE(view.says("the instructor's window is open")) << view.said();
  ASSERT_TRUE(view.says("Do you take part?")) << view.said();
  click(InstructorAction::Next);  // without effect, since only the participant may consent
  ASSERT_EQ(xdotool("search --name '^TouchAFM$' windowfocus key 1").exit_code, 0);
  ASSERT_TRUE(view.says("Words of hello")) << view.said();
  click(InstructorAction::Next);
  ASSERT_TRUE(view.says("Words of feel")) << view.said();
  ASSERT_TRUE(view.says("jump to contact")) << view.said();
  picture("cycle");
  key("KP_Enter");
  ASSERT_TRUE(view.says("force off: Stop was pressed")) << view.said();

  click(InstructorAction::HandOff);
  ASSERT_TRUE(view.says("instructor: the force is off")) << view.said();
  // the simulated hand goes on trying: with a force it would soon let go, or snap in again
  std::this_thread::sleep_for(std::chrono::seconds(4));
  const std::string all = view.said();
  const std::string meanwhile = all.substr(all.find("the force is off"));
  EXPECT_THAT(meanwhile, Not(HasSubstr("jump to contact")));
  EXPECT_THAT(meanwhile, Not(HasSubstr("jump off contact")));
  picture("hand-off");
  key("4");
  ASSERT_TRUE(view.says("instructor: the force is allowed again")) << view.said();

  key("2");
  ASSERT_TRUE(view.says("question 1 of 6")) << view.said();
  click(InstructorAction::Stop);
  ASSERT_TRUE(view.says("press Stop again")) << view.said();
  picture("really-stop");
  click(InstructorAction::Stop);
  ASSERT_TRUE(view.says("The lesson ends here")) << view.said();
  key("Escape");
  EXPECT_EQ(view.ends(), 0) << view.said();
  EXPECT_THAT(core::read_file(out + "/participants.tsv").value(), HasSubstr("sub-QXWERT\t0\tn/a\tstopped"));
}

TEST_F(InstructorTest, NeedsAMonitorThatIsThere) {
  const auto missing = support::run_program("env -u WAYLAND_DISPLAY DISPLAY=" + monitors_.name() + " " +
                                            support::touchafm() + " lesson " + file_ + " --instructor TV");
  EXPECT_EQ(missing.exit_code, 4);
  EXPECT_THAT(missing.err, HasSubstr("--instructor: there is no monitor \"TV\"; choose from: 1 DUMMY0"));
  const auto simulated = support::run_program(support::touchafm() + " lesson " + file_ + " --participant sim:1 --out " +
                                              folder_.file("study") + " --instructor window");
  EXPECT_EQ(simulated.exit_code, 2);
  EXPECT_THAT(simulated.err, HasSubstr("--instructor: a simulated participant has no window"));
}

}  // namespace instructor_test
}  // namespace afm::app
