// SPDX-License-Identifier: Apache-2.0
// Where windows stand: with a window manager, with one that refuses, on a monitor that changes its mode, and on
// displays of other depths.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/two_monitors.h"
#include "support/virtual_display.h"

// behind all others, since its macros spoil their names
#include <X11/Xlib.h>

namespace afm::app {
namespace window_place_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

support::ProgramResult run_on(const std::string& display, const std::string& command) {
  return support::run_program("env -u WAYLAND_DISPLAY DISPLAY=" + display + " " + command);
}

std::string output(const std::string& name, const std::string& rect) {
  return "[[output]]\nname = \"" + name + "\"\nscreen = \"wall\"\nmode = \"mono\"\nrect = [" + rect + "]\n";
}

constexpr const char* kWall = R"([[screen]]
name = "wall"
lower_left = [-1.5, 0.4, 0]
lower_right = [1.5, 0.4, 0]
upper_left = [-1.5, 2.4, 0]
[[viewer]]
name = "visitor"
ipd = "63 mm"
sweet_spot = [0, 1.6, 2.5]
)";

std::vector<std::string> view(std::vector<std::string> more) {
  std::vector<std::string> all{support::touchafm(), "view", "--frame-rate", "12", "--servo", support::servo_mode()};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// True once the window has that place and size, as xdotool says them.
bool stands(const std::string& display, const std::string& name, const std::string& place, const std::string& size) {
  return eventually([&] {
    const std::string said = run_on(display, "xdotool search --name '" + name + "' getwindowgeometry").out;
    return said.find("Position: " + place + " ") != std::string::npos &&
           said.find("Geometry: " + size + "\n") != std::string::npos;
  });
}

// A manager that puts every window at 50,40 and lets none move.
class StubbornManager {
 public:
  explicit StubbornManager(const std::string& name) : display_(XOpenDisplay(name.c_str()), XCloseDisplay) {
    XSelectInput(display_.get(), DefaultRootWindow(display_.get()), SubstructureRedirectMask);
    XSync(display_.get(), False);
    thread_ = std::thread([this] { manage(); });
  }
  StubbornManager(const StubbornManager&) = delete;
  StubbornManager& operator=(const StubbornManager&) = delete;
  ~StubbornManager() {
    ending_ = true;
    thread_.join();
  }

 private:
  void manage() {
    while (!ending_) {
      while (XPending(display_.get()) > 0) {
        XEvent event;
        XNextEvent(display_.get(), &event);
        if (event.type != MapRequest) continue;  // other events configure nothing
        XMoveWindow(display_.get(), event.xmaprequest.window, 50, 40);
        XMapWindow(display_.get(), event.xmaprequest.window);
        XFlush(display_.get());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  std::unique_ptr<Display, int (*)(Display*)> display_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

TEST(WindowPlace, IsThatOfTheWallFileUnderAWindowManager) {
  const support::ScratchFolder folder;
  const support::VirtualDisplay display(800, 600);
  const std::string wall =
      folder.write("wall.toml", kWall + output("left", "20, 45, 240, 180") + output("right", "500, 333, 240, 160"));
  const support::LiveProgram manager({"/usr/bin/openbox", "--sm-disable"}, display.name());
  ASSERT_TRUE(eventually([&] { return run_on(display.name(), "xdotool get_num_desktops").exit_code == 0; }));
  support::LiveProgram program(view({"--wall", wall}), display.name());
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  EXPECT_TRUE(stands(display.name(), "TouchAFM, left", "20,45", "240x180"));
  EXPECT_TRUE(stands(display.name(), "TouchAFM, right", "500,333", "240x160"));

  // also after the window has been moved by somebody
  ASSERT_EQ(run_on(display.name(), "xdotool search --name 'TouchAFM, left' windowmove 300 200").exit_code, 0);
  EXPECT_TRUE(stands(display.name(), "TouchAFM, left", "20,45", "240x180"));
  EXPECT_THAT(program.said(), Not(HasSubstr("the window manager keeps")));
  program.signal(SIGTERM);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

TEST(WindowPlace, ThatTheManagerRefusesIsSaid) {
  const support::ScratchFolder folder;
  const support::VirtualDisplay display(640, 480);
  const std::string wall = folder.write("wall.toml", kWall + output("left", "300, 200, 240, 180"));
  const StubbornManager manager(display.name());
  support::LiveProgram program(view({"--wall", wall}), display.name());
  ASSERT_TRUE(program.says("the window manager keeps its window of 240 x 180 pixels at 50, 40")) << program.said();
  EXPECT_THAT(program.said(), AllOf(HasSubstr("output \"left\""), HasSubstr("240 x 180 pixels at 300, 200")));
  program.signal(SIGTERM);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

TEST(WindowPlace, OfAFullScreenFollowsANewModeWithoutAManager) {
  const support::TwoMonitors monitors;
  monitors.xrandr("--newmode tiny 4.00 256 264 280 320 192 195 199 204");
  monitors.xrandr("--addmode DUMMY0 tiny");
  support::LiveProgram program(view({"--monitor", "DUMMY0"}), monitors.name());
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  EXPECT_TRUE(stands(monitors.name(), "^TouchAFM$", "0,0", "320x240"));
  monitors.xrandr("--output DUMMY0 --mode tiny");
  EXPECT_TRUE(stands(monitors.name(), "^TouchAFM$", "0,0", "256x192"));
  monitors.xrandr("--output DUMMY0 --mode small");
  EXPECT_TRUE(stands(monitors.name(), "^TouchAFM$", "0,0", "320x240"));
  program.signal(SIGTERM);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

// Mesa 22.3's processor driver sends pictures of 24 bits, which an X server of 30 bits refuses.
TEST(WindowOfADisplay, With30BitsShowsThePictureOfOneWith24) {
  const auto shown = [](int depth) {
    const support::VirtualDisplay display(640, 480, depth);
    support::LiveProgram program(view({"--size", "320x240", "--eye-width", "320", "--frame-budget", "none"}),
                                 display.name());
    EXPECT_TRUE(program.says("Choose a sample")) << program.said();
    EXPECT_EQ(run_on(display.name(), "xdotool search --onlyvisible --name '^TouchAFM$'").exit_code, 0);
    const auto bright = [](const render::Image& image) {
      return std::count_if(image.rgba.begin(), image.rgba.end(), [](std::uint8_t value) { return value > 40; }) >
             std::ptrdiff_t{320} * 240 * 3 / 2;
    };
    render::Image image;
    EXPECT_TRUE(eventually([&] {
      image = display.screenshot();
      return bright(image);
    })) << depth;
    program.signal(SIGTERM);
    EXPECT_EQ(program.ends(), 0) << program.said();
    return image;
  };
  const render::Image with_30 = shown(30), with_24 = shown(24);
  ASSERT_EQ(with_30.rgba.size(), with_24.rgba.size());
  std::size_t differ = 0;
  for (std::size_t i = 0; i < with_30.rgba.size(); ++i)
    differ += std::abs(with_30.rgba[i] - with_24.rgba[i]) > 8 ? 1U : 0U;
  EXPECT_LT(differ, with_30.rgba.size() / 50) << "colours in another order would differ everywhere";
}

TEST(WindowOfADisplay, With30BitsIsGood) {
  const support::VirtualDisplay display(640, 480, 30);
  EXPECT_THAT(run_on(display.name(), support::touchafm() + " doctor --seconds 0.1").out,
              ::testing::ContainsRegex("display +good"));
}

// An unusable display is not called good; the message names it as the cause.
TEST(WindowOfADisplay, ThatCannotBeUsedIsCalledSo) {
  for (const int depth : {8, 16}) {
    const support::VirtualDisplay display(640, 480, depth);
    const auto refused = run_on(display.name(), support::touchafm() + " view");
    EXPECT_EQ(refused.exit_code, 4) << depth;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("depth of 24 or 30 bits"), Not(HasSubstr("install a Vulkan driver"))));
    EXPECT_THAT(run_on(display.name(), support::touchafm() + " doctor --seconds 0.1").out,
                AllOf(::testing::ContainsRegex("display +missing"), HasSubstr("depth of 24 or 30 bits")));
    EXPECT_THAT(run_on(display.name(), support::touchafm() + " devices").out,
                ::testing::ContainsRegex("monitor +screen +not usable .*depth of 24 or 30 bits"));
  }
  EXPECT_THAT(run_on(":9999", support::touchafm() + " doctor --seconds 0.1").out,
              AllOf(::testing::ContainsRegex("display +missing +DISPLAY=:9999"), HasSubstr("no display to blank")));
}

}  // namespace window_place_test
}  // namespace afm::app
