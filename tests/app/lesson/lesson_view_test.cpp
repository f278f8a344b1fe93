// SPDX-License-Identifier: Apache-2.0
// A lesson in the real window, on an X server without a screen: keys answer, the servo's events meet the criteria, and
// what a blind step hides is not on the picture.
// Invariant: a blind step shows, says or plays nothing that reveals its sample
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <thread>
#include <vector>

#include "core/whole_file.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/lesson/lesson_panel.h"
#include "render/image_file.h"
#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/sweet_spot.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace lesson_view_test {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

const std::string kWords = "words = { en = \"Words of ";

std::string words(const std::string& step) { return kWords + step + ".\", de = \"Worte.\" }\n"; }

class LessonView : public ::testing::Test {
 protected:
  static constexpr int kWidth = 640, kHeight = 480;

  std::vector<std::string> command(const std::string& file, std::vector<std::string> more = {},
                                   const std::string& hand = "sim") const {
    std::vector<std::string> all{support::touchafm(),   "lesson",     file,          "--size", "640x480",
                                 "--frame-rate",        "12",         "--eye-width", "320",    "--servo",
                                 support::servo_mode(), "--validate", "--haptics",   hand};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void key(const std::string& name) const {
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool key " + name);
    ASSERT_EQ(done.exit_code, 0) << done.err << " (package xdotool)";
  }
  // Clicks on this target of the guide, as seen by one eye.
  void click(std::size_t target, std::size_t targets) const {
    exhibit::ExhibitFiles files;
    files.assets_dir = support::source("assets");
    files.aspect = static_cast<double>(kWidth) / kHeight;
    exhibit::Stage stage = exhibit::load_exhibit(files).value();
    stage.wall.viewers.front().ipd_m = 0.0;
    const auto place = exhibit::lesson_places(stage.wall_scene.places().parameters(), targets).targets.at(target);
    const glm::dvec3 middle_m = place.lower_left_m + 0.5 * (place.right_m + place.up_m);
    const scene::EyeView eye = support::eyes_at_sweet_spot(stage.wall)[0];
    const glm::dvec4 clip = eye.projection * eye.view * glm::dvec4(middle_m, 1.0);
    const glm::dvec2 pixel = 0.5 * glm::dvec2(kWidth, kHeight) * (glm::dvec2(clip) / clip.w + 1.0);
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool mousemove " +
                                           std::to_string(std::lround(pixel.x)) + " " +
                                           std::to_string(std::lround(pixel.y)) + " click 1");
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  // Kept in the build tree for people to look at.
  void picture(const std::string& name) const {
    EXPECT_TRUE(render::write_png(display_.screenshot(), support::built("lesson-") + name + ".png"));
  }
  std::string lesson(const std::string& steps, const std::string& scale = "common") const {
    return folder_.write("lesson.toml",
                         "id = \"a-lesson\"\ntitle = { en = \"A lesson\", de = \"Lektion\" }\nminutes = 5\n"
                         "materials = [\"mica\", \"si3n4\"]\nscale = \"" +
                             scale + "\"\n" + steps);
  }

  const support::ScratchFolder folder_;
  support::VirtualDisplay display_{kWidth, kHeight};
};

TEST_F(LessonView, GoesFromConsentThroughTextAndCycleToTheEndAndKeepsItsTrials) {
  const std::string file =
      lesson("[[step]]\nid = \"hello\"\ntype = \"text\"\n" + words("hello") +
                 "[[step]]\nid = \"feel\"\ntype = \"cycle\"\nmaterial = \"mica\"\n" + words("feel") +
                 "[[step]]\nid = \"ask\"\ntype = \"question\"\nquestionnaire = \"tlx\"\n" + words("ask"),
             "fit");
  const std::string out = folder_.file("study");
  support::LiveProgram view(command(file, {"--participant", "QXWERT", "--out", out, "--age-band", "18-24"}),
                            display_.name());
  ASSERT_TRUE(view.says("Do you take part?")) << view.said();
  EXPECT_FALSE(fs::exists(out + "/participants.tsv")) << "nothing is kept before the consent";
  key("1");
  ASSERT_TRUE(view.says("Words of hello")) << view.said();
  picture("text");
  key("Return");
  ASSERT_TRUE(view.says("Words of feel")) << view.said();
  ASSERT_TRUE(view.says("jump off contact")) << "by the simulated hand: " << view.said();
  ASSERT_TRUE(view.says("question 1 of 6")) << "it goes on by itself: " << view.said();
  for (int item = 1; item <= 6; ++item) {
    if (item > 1) {
      ASSERT_TRUE(view.says("question " + std::to_string(item))) << view.said();
    }
    if (item == 1) key("9 minus");
    if (item == 2) picture("scale");
    if (item == 3) {  // pointer on less, and on the mark itself
      click(0, 3);
      click(1, 3);
      continue;
    }
    key("Return");
  }
  ASSERT_TRUE(view.says("The lesson is finished")) << view.said();
  key("Escape");
  EXPECT_EQ(view.ends(), 0) << view.said();
  const std::string events = core::read_file(out + "/sub-QXWERT/beh/sub-QXWERT_task-alesson_events.tsv").value();
  EXPECT_THAT(events, HasSubstr("\thello\ttext\t"));
  EXPECT_THAT(events, HasSubstr("\tfeel\tcycle\tn/a\t0\t1\tn/a\tn/a\t1.39989e-09\t"));
  EXPECT_THAT(events, HasSubstr("\ttlx-1\t95\t")) << "the upper end, and a step less";
  EXPECT_THAT(events, HasSubstr("\ttlx-3\t45\t"));
  EXPECT_THAT(events, HasSubstr("\ttlx-6\t50\t"));
  EXPECT_THAT(core::read_file(out + "/participants.tsv").value(), HasSubstr("sub-QXWERT\t0\t18-24\tfinished"));
  EXPECT_TRUE(fs::exists(out + "/sub-QXWERT/task-a-lesson_session/session-mica.afms")) << view.said();
}

// Stop takes the force from a tip in contact: the lesson says what became of the cycle, and counts the next one.
TEST_F(LessonView, CountsNoCycleThatLostItsForce) {
  const std::string file =
      lesson("[[step]]\nid = \"feel\"\ntype = \"cycle\"\nmaterial = \"mica\"\n" + words("feel"), "fit");
  const std::string out = folder_.file("study");
  support::LiveProgram view(command(file, {"--participant", "QXWERT", "--out", out}), display_.name());
  ASSERT_TRUE(view.says("Do you take part?")) << view.said();
  key("1");
  ASSERT_TRUE(view.says("Words of feel")) << view.said();
  ASSERT_TRUE(view.says("jump to contact")) << view.said();
  key("Return");
  ASSERT_TRUE(view.says("That cycle does not count: the force was not on")) << view.said();
  picture("not-felt");
  ASSERT_TRUE(view.says("The lesson is finished", std::chrono::minutes(2))) << view.said();
  key("Escape");
  EXPECT_EQ(view.ends(), 0) << view.said();
  const std::string events = core::read_file(out + "/sub-QXWERT/beh/sub-QXWERT_task-alesson_events.tsv").value();
  EXPECT_THAT(events, HasSubstr("\tfeel\tcycle\tn/a\t0\t1\tn/a\tn/a\tn/a\tn/a\tn/a\t0\t"));
  EXPECT_THAT(events, HasSubstr("\tfeel\tcycle\tn/a\t0\t1\tn/a\tn/a\t1.39989e-09\tn/a\tn/a\t1\t"));
}

TEST_F(LessonView, LeavesNothingOfAPersonWhoDoesNotTakePart) {
  const std::string file = lesson("[[step]]\nid = \"hello\"\ntype = \"text\"\n" + words("hello"));
  support::LiveProgram view(command(file, {"--participant", "QXWERT", "--out", folder_.file("study")}),
                            display_.name());
  ASSERT_TRUE(view.says("Do you take part?")) << view.said();
  key("2");
  ASSERT_TRUE(view.says("The lesson ends here")) << view.said();
  key("Escape");
  EXPECT_EQ(view.ends(), 0) << view.said();
  EXPECT_FALSE(fs::exists(folder_.file("study"))) << view.said();
}

// By this participant's numbers the second cycle of the threshold is the stronger one, and the sample to be identified
// is the one that the threshold varied.
TEST_F(LessonView, LaysTheVariantsOfAThresholdAndHidesWhatABlindStepAsksFor) {
  const std::string file = lesson(
      "[[step]]\nid = \"harder\"\ntype = \"threshold\"\nmaterial = \"si3n4\"\nstaircase = \"weighted\"\n"
      "distance = \"kept\"\nstart = 0.5\ntrials = 1\n" +
      words("harder") + "[[step]]\nid = \"blind\"\ntype = \"identify\"\ntrials = 1\n" + words("blind"));
  const std::string out = folder_.file("study");
  support::LiveProgram view(command(file, {"--participant", "QXWEAC", "--out", out}), display_.name());
  ASSERT_TRUE(view.says("Do you take part?")) << view.said();
  key("1");
  ASSERT_TRUE(view.says("First cycle.")) << view.said();
  ASSERT_TRUE(view.says("Second cycle.", std::chrono::minutes(2))) << view.said();
  ASSERT_TRUE(view.says("Which cycle needed more force to let go?", std::chrono::minutes(2))) << view.said();
  // one of them is half as strong again
  EXPECT_THAT(view.said(), HasSubstr("pull 0.9001 nN"));
  EXPECT_THAT(view.said(), HasSubstr("pull 0.6000 nN"));
  // a person thinks before the answer; the simulated hand has meanwhile begun the next cycle on the old sample
  std::this_thread::sleep_for(std::chrono::seconds(2));
  key("2");
  ASSERT_TRUE(view.says("Words of blind")) << view.said();
  picture("blind");
  for (const char* locked : {"F2", "m", "i", "1"}) key(locked);  // keys that would change or choose the sample
  ASSERT_TRUE(view.says("pull 0.6000 nN", std::chrono::minutes(2))) << "the sample is as loaded again: " << view.said();
  ASSERT_TRUE(view.says("Which sample was it?")) << view.said();
  EXPECT_THAT(view.said(), Not(HasSubstr("chosen: "))) << "the log of a blind step names no sample";
  EXPECT_THAT(view.said(), Not(HasSubstr("scale fit")));
  EXPECT_THAT(view.said(), Not(HasSubstr("nobody sees"))) << "a picture that is hidden on purpose keeps its force";
  picture("which");
  key("2");
  ASSERT_TRUE(view.says("The lesson is finished")) << view.said();
  key("Escape");
  EXPECT_EQ(view.ends(), 0) << view.said();
  const std::string events = core::read_file(out + "/sub-QXWEAC/beh/sub-QXWEAC_task-alesson_events.tsv").value();
  EXPECT_THAT(events, HasSubstr("\tharder\tthreshold\tn/a\t0\t1\t0.5\tsecond\tsecond\t1\t"));
  EXPECT_THAT(events, HasSubstr("\tblind\tidentify\tn/a\t0\t1\tn/a\tsi3n4\tsi3n4\t1\t"));
}

TEST_F(LessonView, KeepsTheLinesToBeWrittenInItsSession) {
  const std::string file = folder_.write(
      "write.toml",
      "id = \"write\"\ntitle = { en = \"Write\", de = \"Schreiben\" }\nminutes = 5\nmaterials = [\"mica\"]\n"
      "particles = \"scratch-pmma\"\n[[step]]\nid = \"letter\"\ntype = \"write\"\n"
      "lines = [[\"-80 nm, 80 nm\", \"80 nm, 80 nm\"], [\"0 nm, 80 nm\", \"0 nm, -80 nm\"]]\nwidth = \"20 nm\"\n" +
          words("letter"));
  const std::string out = folder_.file("study");
  support::LiveProgram view(command(file, {"--participant", "QXWERT", "--out", out}), display_.name());
  ASSERT_TRUE(view.says("Do you take part?")) << view.said();
  key("1");
  ASSERT_TRUE(view.says("Words of letter")) << view.said();
  ASSERT_TRUE(view.says("force on")) << view.said();
  key("Escape");
  EXPECT_EQ(view.ends(), 0) << view.said();
  auto session = servo::load_session(out + "/sub-QXWERT/task-write_session/session-mica.afms");
  ASSERT_TRUE(session) << session.error().message;
  ASSERT_FALSE(session->wall.empty());
  const auto draw = [&](const std::string& name) {
    EXPECT_TRUE(servo::save_session(*session, folder_.file(name + ".afms")));
    const auto drawn = support::run_program(support::touchafm() + " render --session " + folder_.file(name + ".afms") +
                                            " --at 0.5 --size 320x240 --out " + folder_.file(name + ".png"));
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    return core::read_file(folder_.file(name + ".png")).value_or("");
  };
  const std::string with = draw("with");
  for (servo::WallFrame& frame : session->wall) {
    ASSERT_TRUE(frame.lines);
    EXPECT_EQ(frame.lines->width_m, 20e-9);
    EXPECT_EQ(frame.lines->lines_m.size(), 2U);
    frame.lines.reset();
  }
  EXPECT_NE(with, draw("without")) << "they are drawn";
}

}  // namespace lesson_view_test
}  // namespace afm::app
