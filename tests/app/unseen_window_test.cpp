// SPDX-License-Identifier: Apache-2.0
// A window that nobody sees, on two monitors of a real X server: the simulated user has the force, and loses it.
#include <X11/Xlib.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/stall_watch.h"
#include "support/two_monitors.h"

namespace afm::app {
namespace unseen_window_test {

using ::testing::HasSubstr;
using ::testing::Not;
using namespace std::chrono_literals;

constexpr support::Milliseconds kMostDark{350.0};

class WindowManager {
 public:
  explicit WindowManager(const std::string& display) : pid_(::fork()) {
    if (pid_ != 0) return;
    ::setenv("DISPLAY", display.c_str(), 1);
    ::execlp("openbox", "openbox", "--sm-disable", nullptr);
    ::_exit(127);
  }
  WindowManager(const WindowManager&) = delete;
  WindowManager& operator=(const WindowManager&) = delete;
  ~WindowManager() {
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
  }

 private:
  pid_t pid_;
};

// Covers the whole desktop, as a locked session does.
class Cover {
 public:
  explicit Cover(const std::string& display) : display_(XOpenDisplay(display.c_str()), XCloseDisplay) {
    XSetWindowAttributes attributes{};
    attributes.override_redirect = True;
    window_ = XCreateWindow(display_.get(), DefaultRootWindow(display_.get()), 0, 0, 2 * support::TwoMonitors::kWidth,
                            support::TwoMonitors::kHeight, 0, CopyFromParent, InputOutput, nullptr, CWOverrideRedirect,
                            &attributes);
  }
  void show() const { sync(XMapRaised(display_.get(), window_)); }
  void hide() const { sync(XUnmapWindow(display_.get(), window_)); }

 private:
  void sync(int /*mapped*/) const { XSync(display_.get(), False); }

  std::unique_ptr<Display, int (*)(Display*)> display_;
  Window window_ = 0;
};

class UnseenWindow : public ::testing::Test {
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
            "80",
            "--frame-rate",
            "20",
            "--record",
            "kept",
            "--servo",
            support::servo_mode(),
            "--haptics",
            "sim",
            "--material",
            "mica",
            "--language",
            "en"};
  }
  void run(const std::string& command) const {
    const auto done = support::run_program("env -u WAYLAND_DISPLAY DISPLAY=" + monitors_.name() + " " + command);
    ASSERT_EQ(done.exit_code, 0) << command << ": " << done.err;
  }
  void start(support::LiveProgram& program) const {
    ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
    run("xdotool search --sync --name '^TouchAFM$' windowfocus key 1");
  }

  // Time from an instant to the first tick without force, by the session.
  std::optional<support::Milliseconds> dark_after(std::int64_t hidden_ns) const {
    const auto session = servo::load_session(folder_.file("kept/session-mica.afms"));
    EXPECT_TRUE(session) << session.error().message;
    if (!session) return std::nullopt;
    const auto dark = std::find_if(session->samples.begin(), session->samples.end(), [&](const scene::TipSample& s) {
      return s.time_ns > hidden_ns && s.servo_state == scene::ServoState::Disarmed;
    });
    if (dark == session->samples.end()) return std::nullopt;
    return std::chrono::nanoseconds(dark->time_ns - hidden_ns);
  }

  // The force is gone in time once the window is hidden, and comes back with the window.
  void loses_force(const std::function<void()>& hide, const std::function<void()>& show, const std::string& cause) {
    support::expect_within(kMostDark, [&] {
      const support::StallWatch watch;
      support::LiveProgram program(view(), monitors_.name());
      start(program);
      EXPECT_TRUE(program.says("force on")) << program.said();
      const std::int64_t hidden_ns = core::MonotonicClock().now_ns();
      hide();
      EXPECT_TRUE(program.says("nobody sees the picture: " + cause)) << program.said();
      EXPECT_TRUE(program.says("force off: nobody sees the picture")) << program.said();
      program.skip_what_it_said();
      EXPECT_FALSE(program.says("force on", 2s)) << program.said();
      show();
      EXPECT_TRUE(program.says("the picture is seen again")) << program.said();
      EXPECT_TRUE(program.says("force on")) << program.said();
      program.signal(SIGINT);
      EXPECT_EQ(program.ends(), 0) << program.said();
      const auto dark = dark_after(hidden_ns);
      EXPECT_TRUE(dark.has_value());
      const support::Milliseconds took = dark.value_or(1s);
      const auto end_ns = hidden_ns + std::chrono::duration_cast<std::chrono::nanoseconds>(took).count();
      return support::Timed{took, watch.longest_between(hidden_ns, end_ns)};
    });
  }

  const support::ScratchFolder folder_;
  const support::TwoMonitors monitors_;
};

TEST_F(UnseenWindow, LosesTheForceWhenMinimised) {
  const WindowManager openbox(monitors_.name());
  loses_force([this] { run("xdotool search --name '^TouchAFM$' windowminimize"); },
              [this] { run("xdotool search --name '^TouchAFM$' windowmap"); }, "the window is minimised");
}

TEST_F(UnseenWindow, LosesTheForceOnAnotherWorkspace) {
  const WindowManager openbox(monitors_.name());
  loses_force([this] { run("xdotool set_desktop 1"); }, [this] { run("xdotool set_desktop 0"); },
              "the window is minimised, or on another workspace");
}

TEST_F(UnseenWindow, LosesTheForceWhenUnmapped) {
  loses_force([this] { run("xdotool search --name '^TouchAFM$' windowunmap"); },
              [this] { run("xdotool search --name '^TouchAFM$' windowmap"); }, "the window is minimised");
}

TEST_F(UnseenWindow, LosesTheForceWhenCovered) {
  const Cover cover(monitors_.name());
  loses_force([&] { cover.show(); }, [&] { cover.hide(); }, "another window covers it");
}

TEST_F(UnseenWindow, LosesTheForceWhenTheScreenSaverBlanksIt) {
  loses_force([this] { run("xset s activate"); }, [this] { run("xset s reset"); }, "the screen saver or DPMS");
}

TEST_F(UnseenWindow, LosesTheForceWhenItsMonitorIsOff) {
  loses_force([this] { monitors_.xrandr("--output DUMMY0 --off"); },
              [this] { monitors_.xrandr("--output DUMMY0 --mode small --pos 0x0"); }, "no monitor shows");
}

// As in a blind step, which hides the picture in the same way.
TEST_F(UnseenWindow, KeepsTheForceUnderABlankPicture) {
  support::LiveProgram program(view(), monitors_.name());
  start(program);
  run("xdotool search --name '^TouchAFM$' windowfocus key x");
  EXPECT_TRUE(program.says("the picture is blank")) << program.said();
  EXPECT_TRUE(program.says("jump off contact")) << program.said();
  program.signal(SIGINT);
  EXPECT_EQ(program.ends(), 0) << program.said();
  EXPECT_THAT(program.said(), Not(HasSubstr("nobody sees")));
}

TEST_F(UnseenWindow, IsNotBlankedByTheScreenSaver) {
  run("xset s 2 2 s blank");
  support::LiveProgram program(view(), monitors_.name());
  start(program);
  EXPECT_FALSE(program.says("nobody sees", 5s)) << program.said();
  program.signal(SIGINT);
  EXPECT_EQ(program.ends(), 0) << program.said();
}

}  // namespace unseen_window_test
}  // namespace afm::app
