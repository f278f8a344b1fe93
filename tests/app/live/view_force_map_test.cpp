// SPDX-License-Identifier: Apache-2.0
// A force map in the real window, on an X server without a screen: a pixel chosen, felt, recorded, replayed.
// Invariant: a pixel of a force map is changed only while the tip is off the sample, and without force
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include "core/whole_file.h"
#include "servo/session_file.h"
#include "support/archives/sticky_map.h"
#include "support/archives/stored_zip.h"
#include "support/live_program.h"
#include "support/pictures.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace view_force_map_test {

using testing::HasSubstr;

constexpr int kWidth = 640, kHeight = 480;
constexpr double kHandPerPixel = 0.085 / 0.30 / kHeight;  // docs/manual/demonstrate.md: a drag over 0.30 of the wall

class ViewForceMap : public ::testing::Test {
 protected:
  void xdotool(const std::string& what) const {
    const auto done = support::run_program("DISPLAY=" + display_.name() + " xdotool " + what);
    ASSERT_EQ(done.exit_code, 0) << "xdotool " << what << ": " << done.err << " (package xdotool)";
  }

  // Presses a key until the log says so: a busy machine may lose one.
  void press(support::LiveProgram& view, const std::string& key, const char* words) const {
    bool said = false;
    for (int presses = 0; presses < 20 && !said; ++presses) {
      xdotool("key " + key);
      said = view.says(words, std::chrono::seconds(2));
    }
    ASSERT_TRUE(said) << view.said();
  }

  // Moves the hand upwards by this, in steps of a pixel with pauses, or at once.
  void lift(double up_m, int steps = 1) const {
    std::string moves = "mousemove 320 240 mousedown 3";
    for (int i = 1; i <= steps; ++i) {
      moves += " sleep 0.04 mousemove 320 " + std::to_string(240 - std::lround(up_m / kHandPerPixel) * i / steps);
    }
    xdotool(moves + " mouseup 3");
  }

  // Lifts, switches the force on, and presses the tip onto the sample. Repeats actions stopped by a busy machine.
  bool touch(support::LiveProgram& view) const {
    for (int tries = 0; tries < 10; ++tries) {
      lift(0.130);
      bool on = false;
      for (int presses = 0; presses < 20 && !on; ++presses) {
        xdotool("key t");
        on = view.says("force on", std::chrono::seconds(2));
      }
      if (!on) return false;
      lift(-0.072, 10);
      if (view.says_one_of({"jump to contact", "force off"}) == "jump to contact") return true;
    }
    return false;
  }

  std::string write_map() const {
    return folder_.write("gel.jpk-force-map", test::stored_zip(test::jpk_map(test::sticky_curve)));
  }

  // Expects moments of a session of the map, drawn again, to match a picture of its window.
  void expect_film(const std::string& session_file, const std::string& map, const render::Image& saved) const {
    const auto session = servo::load_session(session_file);
    ASSERT_TRUE(session) << session.error().message;
    ASSERT_TRUE(session->force_map);
    EXPECT_EQ(session->force_map->file, map);
    const auto draw = [&](double at_s, const std::string& more = "") {
      return support::run_program(support::touchafm() + " render --size 320x240 --session " + session_file + " --at " +
                                  std::to_string(at_s) + " --out " + folder_.file("moment.png") + more);
    };
    // the newest frame may show a tick that was no longer recorded
    const double end_s =
        session->seconds_since_start(std::min(session->wall.back().time_ns, session->samples.back().time_ns));
    const auto end = draw(end_s);
    ASSERT_EQ(end.exit_code, 0) << end.err;
    const render::Image last = test::read_png(folder_.file("moment.png"));
    // the figures of the servo and of the depth meter differ
    EXPECT_LT(test::difference(saved, last, 24).share_beyond, 0.04);
    ASSERT_EQ(draw(0.0).exit_code, 0);
    EXPECT_GT(test::difference(saved, test::read_png(folder_.file("moment.png")), 24).share_beyond, 0.04)
        << "the slice, and the colours of the adhesion";

    std::filesystem::create_directory(folder_.file("elsewhere"));
    const std::string name = "elsewhere/" + std::filesystem::path(map).filename().string();
    const std::string moved = folder_.file(name);
    std::filesystem::rename(map, moved);
    const auto missing = draw(end_s);
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_THAT(missing.err,
                HasSubstr("its force map " + map + " is missing; give the place of the file with --force-map"));
    ASSERT_EQ(draw(end_s, " --force-map " + moved).exit_code, 0);
    EXPECT_EQ(test::difference(test::read_png(folder_.file("moment.png")), last, 0).largest, 0) << "the same bytes";
    folder_.write(name, core::read_file(moved).value() + " ");
    const auto changed = draw(end_s, " --force-map " + moved);
    EXPECT_EQ(changed.exit_code, 3);
    EXPECT_THAT(changed.err, HasSubstr(moved + " is not the force map that was felt, or has changed since"));
  }

  // Expects a moment of a session of one pixel to show the picture of its map; without the file it is drawn, too.
  void expect_picture_of_map(const std::string& session) const {
    const auto draw = [&](const std::string& more = "") {
      const auto drawn = support::run_program(support::touchafm() + " render --size 320x240 --session " + session +
                                              " --out " + folder_.file("moment.png") + more);
      EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
      return std::pair(drawn.err, test::read_png(folder_.file("moment.png")));
    };
    const render::Image there = draw().second;
    const std::string map = folder_.file("gel.jpk-force-map"), moved = folder_.file("elsewhere/gel.jpk-force-map");
    std::filesystem::create_directories(folder_.file("elsewhere"));
    std::filesystem::rename(map, moved);
    const auto [said, without] = draw();
    EXPECT_THAT(said, HasSubstr("its force map " + map + " is missing"));
    EXPECT_THAT(said, HasSubstr("the picture of the map is left out"));
    EXPECT_GT(test::difference(there, without, 24).share_beyond, 0.01) << "the picture of the map";
    EXPECT_EQ(test::difference(there, draw(" --force-map " + moved).second, 0).largest, 0) << "the same bytes";
    std::filesystem::rename(moved, map);
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{kWidth, kHeight};
};

TEST_F(ViewForceMap, IsFeltPixelByPixelAndReplayedBitForBit) {
  support::LiveProgram view(
      {support::touchafm(), "view", "--force-map", write_map(), "--size", "640x480", "--eye-width", "320",
       "--frame-rate", "12", "--servo", support::servo_mode(), "--record", folder_.file("kept"), "--validate"},
      display_.name());
  ASSERT_TRUE(view.says("3 x 2 pixels; felt first: 1,1")) << view.said();
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  xdotool("search --sync --name TouchAFM");
  ASSERT_TRUE(touch(view)) << view.said();
  xdotool("key plus");
  ASSERT_TRUE(view.says("force map: lift the tip off the sample")) << view.said();
  lift(0.130);
  ASSERT_NE(view.says_one_of({"jump off contact", "force off"}), "") << view.said();
  xdotool("key plus");
  ASSERT_TRUE(view.says("force map: pixel 2,1")) << view.said();
  ASSERT_TRUE(view.says("the changed parameters are now in effect")) << view.said();
  ASSERT_TRUE(touch(view)) << view.said();
  lift(0.130);
  ASSERT_NE(view.says_one_of({"jump off contact", "force off"}), "") << view.said();
  xdotool("key Escape");
  ASSERT_EQ(view.ends(), 0) << view.said();

  std::size_t first = 0, second = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder_.file("kept"))) {
    if (file.path().extension() != ".afms") continue;
    const auto session = servo::load_session(file.path());
    ASSERT_TRUE(session) << session.error().message;
    ASSERT_TRUE(session->curve);
    const bool touched = session->find(physics::EventKind::JumpToContact) != nullptr;
    if (touched && session->curve->column == 1) ++first;
    if (touched && session->curve->column == 2) ++second;
    EXPECT_EQ(session->curve->row, 1);
    const auto replayed = support::run_program(support::touchafm() + " replay " + file.path().string());
    EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("is identical, bit for bit"));
    EXPECT_THAT(replayed.out, HasSubstr("felt at pixel " + std::to_string(session->curve->column) + ",1"));
    const auto drawn = support::run_program(support::touchafm() + " render --eye-width 64 --session " +
                                            file.path().string() + " --out " + folder_.file("moment.png"));
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    expect_picture_of_map(file.path());
  }
  EXPECT_GE(first, 1U) << "no session of the pixel of the start touches";
  EXPECT_GE(second, 1U) << "no session of the chosen pixel touches";
}

// One pixel is a gel of 3 kPa, with a lever of 0.05 N/m; 22 times the spring constant means 22 times the force.
TEST_F(ViewForceMap, ShowsTheModulusOfItsFitsAndTheOtherPictures) {
  const auto curve = [](std::size_t index) { return index == 0 ? test::hertz_curve() : test::sticky_curve(index); };
  const std::string map = folder_.write("gel.jpk-force-map", test::stored_zip(test::jpk_map(curve)));
  support::LiveProgram view({support::touchafm(), "view", "--force-map", map, "--fit", "paraboloid", "--radius", "5um",
                             "--spring-constant", "1.1N/m", "--size", "640x480", "--eye-width", "320", "--frame-rate",
                             "12", "--servo", support::servo_mode(), "--validate"},
                            display_.name());
  ASSERT_TRUE(view.says("doubtful, ")) << view.said();
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  xdotool("search --sync --name TouchAFM");
  for (const char* shown :
       {"the picture shows the adhesion", "the picture shows the height", "the picture shows the modulus, 6"}) {
    press(view, "F4", shown);
  }
  xdotool("key Escape");
  ASSERT_EQ(view.ends(), 0) << view.said();
}

TEST_F(ViewForceMap, IsFeltWholeAndReplayedBitForBit) {
  const std::string map = folder_.file("rubber.h5");
  const auto made = support::run_program(
      support::touchafm() +
      " generate map --pixels 4x3 --size 1um --field step --law jkr --modulus 5MPa --second-modulus 20MPa"
      " --work-of-adhesion 30mJ/m2 --second-work-of-adhesion 40mJ/m2 --radius 30nm --spring-constant 0.2N/m"
      " --most-force 1nN --noise 10pN --points 300 --out " +
      map);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  support::LiveProgram view({support::touchafm(),
                             "view",
                             "--force-map",
                             map,
                             "--fit",
                             "jkr",
                             "--radius",
                             "30nm",
                             "--felt",
                             "map",
                             "--viscous-map",
                             "--map-vibration",
                             "adhesion",
                             "--equal-force",
                             "0.5nN",
                             "--size",
                             "640x480",
                             "--eye-width",
                             "320",
                             "--frame-rate",
                             "12",
                             "--servo",
                             support::servo_mode(),
                             "--record",
                             folder_.file("whole"),
                             "--pictures",
                             folder_.path(),
                             "--validate"},
                            display_.name());
  ASSERT_TRUE(view.says("a hand that moves near the sample feels the adhesion as a vibration")) << view.said();
  ASSERT_TRUE(view.says("the whole map is felt: E ")) << view.said();
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  ASSERT_TRUE(view.says("the surface of 500 pN, which 12 of 12 curves reach")) << view.said();
  xdotool("search --sync --name TouchAFM");
  ASSERT_TRUE(touch(view)) << view.said();
  lift(0.130);
  ASSERT_NE(view.says_one_of({"jump off contact", "force off"}), "") << view.said();
  press(view, "F10", "a slice shows the forces along the tip's line");
  press(view, "F4", "the picture shows the adhesion");
  // until the marks of the last event on the wall have faded
  render::Image saved, before;
  for (int picture = 1; picture <= 20; ++picture) {
    const std::string name = "touchafm-0" + std::string(picture < 10 ? "0" : "") + std::to_string(picture) + ".png";
    xdotool("key F12");
    ASSERT_TRUE(view.says(name)) << view.said();
    before = std::exchange(saved, test::read_png(folder_.file(name)));
    if (picture > 1 && test::difference(saved, before, 24).share_beyond < 0.001) break;
  }
  xdotool("key Escape");
  ASSERT_EQ(view.ends(), 0) << view.said();
  int touched = 0;
  std::string last;
  for (const auto& file : std::filesystem::directory_iterator(folder_.file("whole"))) {
    if (file.path().extension() != ".afms") continue;
    const auto session = servo::load_session(file.path());
    ASSERT_TRUE(session) << session.error().message;
    ASSERT_TRUE(session->law_map);
    if (session->find(physics::EventKind::JumpToContact) != nullptr) ++touched;
    if (last.empty() || std::filesystem::last_write_time(file) > std::filesystem::last_write_time(last))
      last = file.path();
    const auto replayed = support::run_program(support::touchafm() + " replay " + file.path().string());
    EXPECT_EQ(replayed.exit_code, 0) << replayed.out << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("felt over a viscous map of modulus and adhesion of 4 x 3 points"));
    EXPECT_THAT(replayed.out, HasSubstr("the adhesion is felt as a vibration"));
    EXPECT_THAT(replayed.out, HasSubstr("is identical, bit for bit"));
  }
  EXPECT_GE(touched, 1) << "no session of the map touches";
  expect_film(last, map, saved);
}

TEST(ViewForceMapFiles, AreRefusedWithTheReason) {
  const support::ScratchFolder folder;
  const std::string bytes = test::stored_zip(test::holed_map());
  folder.write("holed.jpk-force-map", bytes);
  folder.write("cut.jpk-force-map", bytes.substr(0, bytes.size() / 2));
  const auto view = [&](const std::string& file, const std::string& more) {
    return support::run_program(support::touchafm() + " view --force-map " + folder.file(file) + " " + more);
  };
  const auto outside = view("holed.jpk-force-map", "--pixel 3,0");
  EXPECT_EQ(outside.exit_code, 2);
  EXPECT_THAT(outside.err, HasSubstr("pixel 3,0 is outside the force map"));
  const auto hole = view("holed.jpk-force-map", "--pixel 2,0");
  EXPECT_EQ(hole.exit_code, 3);
  EXPECT_THAT(hole.err, HasSubstr("has no curve at pixel 2,0"));
  const auto cut = view("cut.jpk-force-map", "");
  EXPECT_EQ(cut.exit_code, 3);
  EXPECT_THAT(cut.err, HasSubstr("it is cut short: its zip archive has no end; copy the file again"));
  const auto words = view("holed.jpk-force-map", "--pixel middle");
  EXPECT_EQ(words.exit_code, 2);
  EXPECT_THAT(words.err, HasSubstr("is not COLUMN,ROW"));
  const auto sizeless = view("holed.jpk-force-map", "--fit paraboloid");
  EXPECT_EQ(sizeless.exit_code, 2);
  EXPECT_THAT(sizeless.err, HasSubstr("--fit paraboloid needs --radius"));
  const auto unfitted = view("holed.jpk-force-map", "--felt map");
  EXPECT_EQ(unfitted.exit_code, 2);
  EXPECT_THAT(unfitted.err, HasSubstr("--felt map: the map is felt by its fits: add --fit SHAPE"));
  const auto lawless = view("holed.jpk-force-map", "--felt map --fit cone --half-angle 20deg");
  EXPECT_EQ(lawless.exit_code, 2);
  EXPECT_THAT(lawless.err, HasSubstr("fit it with --fit dmt, jkr, paraboloid or sphere"));
  const auto surfaceless = view("holed.jpk-force-map", "--equal-force 1nN");
  EXPECT_EQ(surfaceless.exit_code, 2);
  EXPECT_THAT(surfaceless.err, HasSubstr("--equal-force: the surface lies over a map that is felt whole"));
  const auto solid = view("holed.jpk-force-map", "--viscous-map");
  EXPECT_EQ(solid.exit_code, 2);
  EXPECT_THAT(solid.err, HasSubstr("--viscous-map: only a map that is felt whole is viscous"));
  const auto still = view("holed.jpk-force-map", "--map-vibration modulus");
  EXPECT_EQ(still.exit_code, 2);
  EXPECT_THAT(still.err, HasSubstr("--map-vibration: only a map that is felt whole vibrates"));
  const auto pad = view("holed.jpk-force-map", "--map-vibration modulus --haptics gamepad");
  EXPECT_EQ(pad.exit_code, 2);
  EXPECT_THAT(pad.err, HasSubstr("the profile of --haptics gamepad has no vibration; use one of hdapi, "));
  const auto made = support::run_program(
      support::touchafm() + " generate map --law jkr --pixels 3x3 --size 1um --modulus 5MPa --radius 30nm" +
      " --work-of-adhesion 30mJ/m2 --spring-constant 0.2N/m --most-force 3nN --noise 5pN --out " +
      folder.file("even.h5"));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const char* const quantity : {"modulus", "adhesion"}) {
    const auto even = view("even.h5", std::string("--felt map --fit jkr --radius 30nm --map-vibration ") + quantity);
    EXPECT_EQ(even.exit_code, 2);
    EXPECT_THAT(even.err, HasSubstr(std::string("the ") + quantity + " of this map differs by less than 5 %"));
  }
  const auto shapeless = view("holed.jpk-force-map", "--radius 50nm");
  EXPECT_EQ(shapeless.exit_code, 2);
  EXPECT_THAT(shapeless.err, HasSubstr("add --fit SHAPE"));
}

}  // namespace view_force_map_test
}  // namespace afm::app
