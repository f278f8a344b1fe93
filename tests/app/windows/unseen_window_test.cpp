// SPDX-License-Identifier: Apache-2.0
// A window that nobody sees, on two monitors of a real X server: the simulated user has the force, and loses it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/clock.h"
#include "support/dark_after.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/stall_watch.h"
#include "support/two_monitors.h"

// behind all others, since its macros spoil their names
#include <X11/Xlib.h>

namespace afm::app {
namespace unseen_window_test {

using ::testing::HasSubstr;
using ::testing::Not;
using namespace std::chrono_literals;

constexpr support::Milliseconds kMostDark{350.0};

class WindowManager {
 public:
  // Returns once it manages windows: one that is mapped while it starts may stay unmapped.
  explicit WindowManager(const std::string& display) : pid_(::fork()) {
    if (pid_ == 0) {
      ::setenv("DISPLAY", display.c_str(), 1);
      ::execlp("openbox", "openbox", "--sm-disable", nullptr);
      ::_exit(127);
    }
    wait(display);
  }
  WindowManager(const WindowManager&) = delete;
  WindowManager& operator=(const WindowManager&) = delete;
  ~WindowManager() {
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
  }

 private:
  static void wait(const std::string& display) {
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (support::run_program("DISPLAY=" + display + " xdotool get_num_desktops").exit_code != 0) {
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error("openbox manages no windows after 20 s");
    }
  }

  pid_t pid_;
};

// Hides a window at once: a program that does so would take longer to start than the force takes to fade.
class Desktop {
 public:
  explicit Desktop(const std::string& display) : display_(XOpenDisplay(display.c_str()), XCloseDisplay) {
    XSetWindowAttributes attributes{};
    attributes.override_redirect = True;
    cover_ =
        XCreateWindow(display_.get(), root(), 0, 0, 2 * support::TwoMonitors::kWidth, support::TwoMonitors::kHeight, 0,
                      CopyFromParent, InputOutput, nullptr, CWOverrideRedirect, &attributes);
  }

  // Covers the window, like a locked session.
  void cover() const { sync(XMapRaised(display_.get(), cover_)); }
  void uncover() const { sync(XUnmapWindow(display_.get(), cover_)); }
  void minimise(::Window window) const { sync(XIconifyWindow(display_.get(), window, 0)); }
  void map(::Window window) const { sync(XMapWindow(display_.get(), window)); }
  void unmap(::Window window) const { sync(XUnmapWindow(display_.get(), window)); }
  void move(::Window window, int x, int y) const { sync(XMoveWindow(display_.get(), window, x, y)); }
  void blank() const { sync(XForceScreenSaver(display_.get(), ScreenSaverActive)); }
  void wake() const { sync(XForceScreenSaver(display_.get(), ScreenSaverReset)); }
  void change_workspace(long number) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = root();
    event.xclient.message_type = XInternAtom(display_.get(), "_NET_CURRENT_DESKTOP", False);
    event.xclient.format = 32;
    event.xclient.data.l[0] = number;
    sync(XSendEvent(display_.get(), root(), False, SubstructureNotifyMask | SubstructureRedirectMask, &event));
  }

 private:
  ::Window root() const { return DefaultRootWindow(display_.get()); }
  void sync(int /*done*/) const { XSync(display_.get(), False); }

  std::unique_ptr<Display, int (*)(Display*)> display_;
  ::Window cover_ = 0;
};

class UnseenWindow : public ::testing::Test {
 protected:
  std::vector<std::string> view() const {
    return {support::touchafm(),
            "view",
            "--size",
            "320x240",
            "--eye-width",
            "80",
            "--record",
            kept(),
            "--servo",
            support::servo_mode(),
            "--haptics",
            "sim",
            "--material",
            "mica",
            "--language",
            "en",
            "--frame-rate",
            "20"};
  }
  std::string kept() const { return folder_.file("kept-" + std::to_string(runs_)); }
  support::ProgramResult run(const std::string& command) const {
    return support::run_program("env -u WAYLAND_DISPLAY DISPLAY=" + monitors_.name() + " " + command);
  }
  void start(support::LiveProgram& program) {
    ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
    const auto found = run("xdotool search --sync --name '^TouchAFM$'");
    ASSERT_EQ(found.exit_code, 0) << found.err;
    window_ = std::stoul(found.out);
    ASSERT_EQ(run("xdotool windowfocus " + std::to_string(window_) + " key 1").exit_code, 0);
  }

  // The force is gone in time once the window is hidden, and comes back with the window.
  void loses_force(const std::function<void()>& hide, const std::function<void()>& show, const std::string& cause) {
    support::expect_within(kMostDark, [&] {
      const support::StallWatch watch;
      ++runs_;
      support::LiveProgram program(view(), monitors_.name());
      start(program);
      EXPECT_TRUE(program.says("force on")) << program.said();
      const std::int64_t asked_ns = core::MonotonicClock().now_ns();
      hide();
      const std::int64_t hidden_ns = hides_by_command_ ? core::MonotonicClock().now_ns() : asked_ns;
      EXPECT_TRUE(program.says("nobody sees the picture: " + cause)) << program.said();
      EXPECT_TRUE(program.says("force off: nobody sees the picture")) << program.said();
      program.skip_what_it_said();
      EXPECT_FALSE(program.says("force on", 2s)) << program.said();
      show();
      EXPECT_TRUE(program.says("the picture is seen again")) << program.said();
      EXPECT_TRUE(program.says("force on")) << program.said();
      program.signal(SIGINT);
      EXPECT_EQ(program.ends(), 0) << program.said();
      return support::dark_after(hidden_ns, kept() + "/session-mica.afms", watch);
    });
  }

  const support::ScratchFolder folder_;
  const support::TwoMonitors monitors_;
  const Desktop desktop_{monitors_.name()};
  ::Window window_ = 0;
  bool hides_by_command_ = false;
  int runs_ = 0;
};

TEST_F(UnseenWindow, LosesTheForceWhenMinimised) {
  const WindowManager openbox(monitors_.name());
  loses_force([this] { desktop_.minimise(window_); }, [this] { desktop_.map(window_); }, "the window is minimised");
}

TEST_F(UnseenWindow, LosesTheForceOnAnotherWorkspace) {
  const WindowManager openbox(monitors_.name());
  loses_force([this] { desktop_.change_workspace(1); }, [this] { desktop_.change_workspace(0); },
              "the window is minimised, or on another workspace");
}

TEST_F(UnseenWindow, LosesTheForceWhenUnmapped) {
  loses_force([this] { desktop_.unmap(window_); }, [this] { desktop_.map(window_); }, "the window is minimised");
}

TEST_F(UnseenWindow, LosesTheForceWhenCovered) {
  loses_force([this] { desktop_.cover(); }, [this] { desktop_.uncover(); }, "another window covers it");
}

TEST_F(UnseenWindow, LosesTheForceWhenTheScreenSaverBlanksIt) {
  loses_force([this] { desktop_.blank(); }, [this] { desktop_.wake(); }, "the screen saver or DPMS");
}

// The window's monitor is the right one, since xrandr moves the monitors that are left to the left. The time counts
// from when the command is done.
TEST_F(UnseenWindow, LosesTheForceWhenItsMonitorIsOff) {
  hides_by_command_ = true;
  const auto hide = [this] {
    desktop_.move(window_, support::TwoMonitors::kWidth, 0);
    monitors_.xrandr("--fb 640x240 --output DUMMY1 --off");
  };
  loses_force(hide, [this] { monitors_.xrandr("--output DUMMY1 --mode small --pos 320x0"); }, "no monitor shows");
}

// The picture is hidden as in a blind step.
TEST_F(UnseenWindow, KeepsTheForceUnderABlankPicture) {
  support::LiveProgram program(view(), monitors_.name());
  start(program);
  EXPECT_EQ(run("xdotool key x").exit_code, 0);
  EXPECT_TRUE(program.says("the picture is blank")) << program.said();
  EXPECT_TRUE(program.says("jump off contact")) << program.said();
  program.signal(SIGINT);
  EXPECT_EQ(program.ends(), 0) << program.said();
  EXPECT_THAT(program.said(), Not(HasSubstr("nobody sees")));
}

TEST_F(UnseenWindow, IsNotBlankedByTheScreenSaver) {
  EXPECT_EQ(run("xset s 2 2 s blank").exit_code, 0);
  support::LiveProgram program(view(), monitors_.name());
  start(program);
  EXPECT_FALSE(program.says("nobody sees", 5s)) << program.said();
  program.signal(SIGINT);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

}  // namespace unseen_window_test
}  // namespace afm::app
