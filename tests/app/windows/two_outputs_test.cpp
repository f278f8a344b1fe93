// SPDX-License-Identifier: Apache-2.0
// The live wall on two monitors of a real X server: a projector for each eye, one by its monitor's name and one by its
// place on the desktop, the right one with a keystone.
// Invariant: each projector shows the image of its eye, with its own keystone, on its monitor
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <string>

#include "exhibit/frame/exhibit_setup.h"
#include "render/image_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/read_png.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/two_monitors.h"

namespace afm::app {
namespace two_outputs_test {

using support::TwoMonitors;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kShrunk = 0.9, kInset = 0.05;  // keystone of the right projector

std::string wall_file(const std::string& left_place) {
  return R"(
[[screen]]
name = "powerwall"
lower_left = [-1.524, 0.400, 0.0]
lower_right = [1.524, 0.400, 0.0]
upper_left = [-1.524, 2.686, 0.0]
[[output]]
name = "left projector"
screen = "powerwall"
mode = "dual"
eye = "left"
)" + left_place +
         R"(
[[output]]
name = "right projector"
screen = "powerwall"
mode = "dual"
eye = "right"
rect = [320, 0, 320, 240]
homography = [0.9, 0, 0.05, 0, 0.9, 0.05, 0, 0, 1]
[[viewer]]
name = "visitor"
ipd = "63 mm"
sweet_spot = [0.0, 1.65, 2.5]
)";
}

class TwoOutputsTest : public ::testing::Test {
 protected:
  TwoOutputsTest() {
    folder_.write("named.toml", wall_file("monitor = \"DUMMY0\""));
    folder_.write("placed.toml", wall_file("rect = [0, 0, 320, 240]"));
    folder_.write("missing.toml", wall_file("monitor = \"HDMI-7\""));
  }
  std::vector<std::string> view(const std::string& wall) const {
    return {support::touchafm(),   "view",      "--wall", folder_.file(wall), "--frame-rate", "12", "--servo",
            support::servo_mode(), "--validate"};
  }
  support::ProgramResult on_display(const std::string& command) const {
    return support::run_program("env -u WAYLAND_DISPLAY DISPLAY=" + monitors_.name() + " " + command);
  }
  // The largest difference of a byte between the two pictures, in columns [first, first + count).
  static int difference(const render::Image& a, const render::Image& b, std::uint32_t first, std::uint32_t count) {
    int largest = a.width == b.width && a.height == b.height ? 0 : 255;
    for (std::uint32_t y = 0; largest < 255 && y < a.height; ++y) {
      for (std::size_t i = 4 * (y * a.width + first); i < 4 * (y * a.width + first + count); ++i) {
        largest = std::max(largest, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
      }
    }
    return largest;
  }
  // Waits until the desktop has the expected contents; returns its last contents.
  template <class Holds>
  render::Image until(Holds&& holds) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    render::Image seen = monitors_.screenshot();
    while (!holds(seen) && std::chrono::steady_clock::now() < end) seen = monitors_.screenshot();
    return seen;
  }

  support::ScratchFolder folder_;
  TwoMonitors monitors_;
};

TEST_F(TwoOutputsTest, EachProjectorShowsWhatIsDrawnForItsEyeThroughItsOwnKeystone) {
  support::LiveProgram program(view("named.toml"), monitors_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  const std::string reference = folder_.file("reference.png");
  ASSERT_EQ(
      on_display(support::touchafm() + " wall " + folder_.file("placed.toml") + " --test-pattern --out " + reference)
          .exit_code,
      0);
  const render::Image drawn = support::read_png(reference).value();
  ASSERT_EQ(drawn.width, 2U * TwoMonitors::kWidth);
  ASSERT_EQ(on_display("xdotool key g").exit_code, 0);
  const render::Image shown = until([&](const auto& seen) { return difference(seen, drawn, 0, drawn.width) == 0; });
  EXPECT_TRUE(render::write_png(shown, support::built("two-outputs-pattern.png")));
  EXPECT_EQ(difference(shown, drawn, 0, TwoMonitors::kWidth), 0) << "the left projector";
  EXPECT_EQ(difference(shown, drawn, TwoMonitors::kWidth, TwoMonitors::kWidth), 0) << "the right projector";

  // the mouse acts as a hand in the second window as in the first
  ASSERT_EQ(on_display("xdotool key g").exit_code, 0);
  exhibit::ExhibitFiles files;
  files.assets_dir = support::source("assets");
  const exhibit::Stage stage = exhibit::load_exhibit(files).value();
  const auto clip =
      stage.eyes[1].projection * stage.eyes[1].view * glm::dvec4(stage.wall_scene.swatch_targets()[1].center_m, 1.0);
  const glm::dvec2 place = kInset + kShrunk * 0.5 * (glm::dvec2(clip) / clip.w + 1.0);
  const auto x = std::lround(TwoMonitors::kWidth * (1.0 + place.x)), y = std::lround(TwoMonitors::kHeight * place.y);
  ASSERT_EQ(on_display("xdotool mousemove " + std::to_string(x) + " " + std::to_string(y) + " click 1").exit_code, 0);
  ASSERT_TRUE(program.says("chosen: Gold")) << program.said();
  EXPECT_TRUE(render::write_png(monitors_.screenshot(), support::built("two-outputs-scene.png")));
  ASSERT_EQ(on_display("xdotool key Escape").exit_code, 0);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

TEST_F(TwoOutputsTest, AMonitorThatIsSwitchedOffAndOnAgainIsFilledAgain) {
  support::LiveProgram program(view("named.toml"), monitors_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  monitors_.xrandr("--output DUMMY0 --off");
  ASSERT_TRUE(program.says("monitor DUMMY0 is lost")) << program.said();
  ASSERT_EQ(on_display("xdotool key 1").exit_code, 0);
  ASSERT_TRUE(program.says("chosen: Mica")) << program.said();
  monitors_.xrandr("--output DUMMY0 --mode small --pos 0x0");
  ASSERT_TRUE(program.says("monitor DUMMY0 is back")) << program.said();
  ASSERT_EQ(on_display("xdotool search --name 'left projector' windowunmap windowmap").exit_code, 0);
  ASSERT_EQ(on_display("xdotool key 2").exit_code, 0);
  ASSERT_TRUE(program.says("chosen: Gold")) << program.said();
  program.signal(SIGTERM);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

TEST_F(TwoOutputsTest, AMonitorUnderARectangleThatIsSwitchedOffAndOnAgainIsFilledAgain) {
  support::LiveProgram program(view("named.toml"), monitors_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  const auto place = [&] { return on_display("xdotool search --name 'right projector' getwindowgeometry").out; };
  EXPECT_THAT(place(), AllOf(HasSubstr("Position: 320,0"), HasSubstr("Geometry: 320x240")));
  monitors_.xrandr("--output DUMMY1 --off");
  ASSERT_TRUE(program.says("output \"right projector\": its monitor is lost")) << program.said();
  EXPECT_THAT(place(), AllOf(HasSubstr("Position: 40,30"), HasSubstr("Geometry: 240x180")));
  ASSERT_EQ(on_display("xdotool key 1").exit_code, 0);
  ASSERT_TRUE(program.says("chosen: Mica")) << program.said();
  monitors_.xrandr("--output DUMMY1 --mode small --pos 320x0");
  ASSERT_TRUE(program.says("output \"right projector\": its monitor is back")) << program.said();
  EXPECT_THAT(place(), AllOf(HasSubstr("Position: 320,0"), HasSubstr("Geometry: 320x240")));
  program.signal(SIGTERM);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

TEST_F(TwoOutputsTest, MonitorsAreListedAndOneThatIsNotThereIsNamed) {
  const auto devices = on_display(support::touchafm() + " devices");
  EXPECT_THAT(devices.out, AllOf(HasSubstr("DUMMY0"), HasSubstr("number 2, 320 x 240 pixels at 320, 0")));
  const auto missing = on_display(support::touchafm() + " view --wall " + folder_.file("missing.toml"));
  EXPECT_EQ(missing.exit_code, 4);
  EXPECT_THAT(missing.err, AllOf(HasSubstr("output \"left projector\": there is no monitor \"HDMI-7\""),
                                 HasSubstr("1 DUMMY0 (320 x 240 at 0, 0), 2 DUMMY1 (320 x 240 at 320, 0)")));
  const auto named = on_display(support::touchafm() + " view --monitor TV");
  EXPECT_EQ(named.exit_code, 4);
  EXPECT_THAT(named.err, HasSubstr("--monitor: there is no monitor \"TV\""));
}

}  // namespace two_outputs_test
}  // namespace afm::app
