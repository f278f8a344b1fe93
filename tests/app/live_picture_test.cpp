// SPDX-License-Identifier: Apache-2.0
// What the live window shows to which eye, by its pixels: the order of the eyes, their distance, the rows of the
// screen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/pictures.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace live_picture_test {

using render::Image;
using namespace std::chrono_literals;

constexpr std::uint32_t kWidth = 320;

// A part of a picture.
Image cut(const Image& whole, std::uint32_t left, std::uint32_t top, std::uint32_t width, std::uint32_t height) {
  Image part{.width = width, .height = height, .rgba = {}};
  for (std::uint32_t y = top; y < top + height; ++y) {
    const auto row = whole.rgba.begin() + 4 * (std::ptrdiff_t{y} * whole.width + left);
    part.rgba.insert(part.rgba.end(), row, row + 4 * std::ptrdiff_t{width});
  }
  return part;
}

// The rows of a picture that lies `down` rows below the screen's first: even rows of the screen are the left eye's.
Image interleaved(const Image& left, const Image& right, std::uint32_t down) {
  Image picture{.width = left.width, .height = left.height, .rgba = {}};
  for (std::uint32_t y = 0; y < left.height; ++y) {
    const Image row = cut((y + down) % 2 == 0 ? left : right, 0, y, left.width, 1);
    picture.rgba.insert(picture.rgba.end(), row.rgba.begin(), row.rgba.end());
  }
  return picture;
}

class LivePictureTest : public ::testing::Test {
 protected:
  std::vector<std::string> view(const std::string& mode, const std::string& size, std::vector<std::string> more = {}) {
    std::vector<std::string> all{
        "/usr/bin/env", "-C", folder_.path(), support::touchafm(),  "view", "--stereo", mode, "--size", size,
        "--frame-rate", "10", "--servo",      support::servo_mode()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void xdotool(const std::string& what) const {
    ASSERT_EQ(support::run_program("DISPLAY=" + display_.name() + " xdotool " + what).exit_code, 0) << what;
  }
  // Whether the screen shows `expected` there, and not `other`, within half a minute. The live pattern has other names
  // beside the same marks.
  bool shows(const Image& expected, const Image& other, std::uint32_t left, std::uint32_t top) const {
    const auto end = std::chrono::steady_clock::now() + 30s;
    const auto apart = [](const Image& a, const Image& b) { return test::difference(a, b, 24).share_beyond; };
    double to_expected = 1.0, to_other = 0.0;
    do {
      const Image seen = cut(display_.screenshot(), left, top, expected.width, expected.height);
      to_expected = apart(seen, expected);
      to_other = apart(seen, other);
      if (to_expected < 0.25 * to_other && to_other > 0.01) return true;
      std::this_thread::sleep_for(100ms);
    } while (std::chrono::steady_clock::now() < end);
    ADD_FAILURE() << to_expected << " of the pixels are not as expected, " << to_other << " not as the other";
    return false;
  }
  // View of one eye on the test pattern, drawn without a window.
  Image pattern_of(const std::string& eye) const {
    const std::string file = folder_.file(eye + ".png");
    const auto drawn = support::run_program(support::touchafm() + " wall " +
                                            support::source("assets/walls/powerwall.toml --test-pattern --stereo ") +
                                            eye + " --size 320x240 --out " + file);
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    return test::read_png(file);
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{700, 300};
};

TEST_F(LivePictureTest, ThatIsSwappedShowsEachEyeTheOthersPicture) {
  const Image left = pattern_of("left"), right = pattern_of("right");
  ASSERT_NE(left.rgba, right.rgba);
  support::LiveProgram program(view("side-by-side", "640x240"), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  xdotool("mousemove 160 10 key g");
  EXPECT_TRUE(shows(left, right, 0, 0));
  EXPECT_TRUE(shows(right, left, kWidth, 0));
  xdotool("key s");
  ASSERT_TRUE(program.says("eyes swapped")) << program.said();
  EXPECT_TRUE(shows(right, left, 0, 0));
  EXPECT_TRUE(shows(left, right, kWidth, 0));
}

// A row-interleaved screen has its polarised rows where they are, wherever the window lies.
TEST_F(LivePictureTest, InRowsGoesByTheRowsOfTheScreen) {
  const Image left = pattern_of("left"), right = pattern_of("right");
  support::LiveProgram program(view("row", "320x240"), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  xdotool("mousemove 160 10 key g");
  const Image even = interleaved(left, right, 0), odd = interleaved(left, right, 1);
  ASSERT_NE(even.rgba, odd.rgba);
  EXPECT_TRUE(shows(even, odd, 0, 0));
  xdotool("search --name TouchAFM windowmove 0 1");
  EXPECT_TRUE(shows(odd, even, 0, 1));
}

// Same for a picture of a whole wall: the lower output begins on an odd row of the desktop.
TEST_F(LivePictureTest, OfAWallInRowsGoesByTheRowsOfTheDesktop) {
  const std::string output = R"([[output]]
name = "NAME"
screen = "powerwall"
mode = "row"
rect = [0, TOP, 320, 240]
)";
  std::string wall = R"([[screen]]
name = "powerwall"
lower_left = [-1.524, 0.400, 0.0]
lower_right = [1.524, 0.400, 0.0]
upper_left = [-1.524, 2.686, 0.0]
[[viewer]]
name = "visitor"
ipd = "63 mm"
sweet_spot = [0.0, 1.65, 2.5]
)";
  for (const char* top : {"0", "241"}) {
    std::string one = output;
    one.replace(one.find("TOP"), 3, top);
    wall += one.replace(one.find("NAME"), 4, std::string("at ") + top);
  }
  folder_.write("rows.toml", wall);
  const auto drawn = support::run_program(support::touchafm() + " wall " + folder_.file("rows.toml") +
                                          " --test-pattern --out " + folder_.file("rows.png"));
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  const Image both = test::read_png(folder_.file("rows.png"));
  ASSERT_EQ(both.height, 481U);
  const Image left = pattern_of("left"), right = pattern_of("right");
  for (const std::uint32_t top : {0U, 241U}) {
    const Image seen = cut(both, 0, top, 320, 240);
    const double as_it_lies = test::difference(seen, interleaved(left, right, top), 24).share_beyond;
    const double a_row_off = test::difference(seen, interleaved(left, right, top + 1), 24).share_beyond;
    EXPECT_LT(as_it_lies, 0.25 * a_row_off) << top;
  }
}

// The eyes of the live picture are at the places that `render` uses for the same distance, but not for half of it.
TEST_F(LivePictureTest, ShowsWhatEyesSoFarApartSee) {
  support::LiveProgram program(view("side-by-side", "640x240",
                                    {"--eye-width", "320", "--ipd", "80mm", "--comfort", "3", "--record", "kept",
                                     "--material", "gold", "--haptics", "mouse"}),
                               display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  xdotool("mousemove 160 10 key 1");
  ASSERT_TRUE(program.says("chosen: Gold")) << program.said();
  xdotool("mousemove 160 120 mousedown 3 mousemove 160 90 mouseup 3");
  for (int presses = 0; presses < 40 && !program.says("force on", 2s); ++presses) xdotool("key t");
  std::this_thread::sleep_for(1s);
  xdotool("key F12");
  ASSERT_TRUE(program.says("saved ./touchafm-001.png")) << program.said();
  xdotool("key Escape");
  ASSERT_EQ(program.ends(), 0) << program.said();

  const std::string kept = folder_.file("kept/session-gold.afms");
  const auto session = servo::load_session(kept);
  ASSERT_TRUE(session) << session.error().message;
  const double end_s =
      session->seconds_since_start(std::min(session->wall.back().time_ns, session->samples.back().time_ns));
  const Image saved = test::read_png(folder_.file("touchafm-001.png"));
  const auto beyond = [&](const std::string& ipd) {
    const std::string file = folder_.file(ipd + ".png");
    const auto drawn =
        support::run_program(support::touchafm() + " render --session " + kept + " --at " + std::to_string(end_s) +
                             " --stereo side-by-side --size 640x240 --ipd " + ipd + " --out " + file);
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    return test::difference(saved, test::read_png(file), 24).share_beyond;
  };
  const double same = beyond("80mm"), half = beyond("40mm");
  RecordProperty("share_beyond", std::to_string(same) + " and " + std::to_string(half));
  // the servo's figures and the depth meter's differ in both
  EXPECT_LT(same, 0.7 * half) << same << " and " << half;
}

}  // namespace live_picture_test
}  // namespace afm::app
