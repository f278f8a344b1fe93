// SPDX-License-Identifier: Apache-2.0
// The live window for a long time under random but legal hands: keys, mouse, wand, tracker and window, with Vulkan's
// calls validated. AFM_SOAK_ACTIONS says how many actions; without it a few, for every run of the tests.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "app/session_file.h"
#include "support/live_program.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/tracker.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kWidth = 320, kHeight = 240;
constexpr int kFewActions = 200;
constexpr auto kPause = std::chrono::milliseconds(40);
// What a heap that is used at random may still take after the first half; a leak of one frame's data is far more.
constexpr double kMostGrowth = 1.10;

// One xdotool for all actions.
class Hands {
 public:
  Hands(const std::string& display, unsigned seed)
      : pipe_(::popen(("DISPLAY=" + display + " xdotool -").c_str(), "w"), ::pclose), random_(seed) {
    const auto found = support::run_program("DISPLAY=" + display + " xdotool search --sync --name '^TouchAFM$'");
    window_ = found.out.substr(0, found.out.find('\n'));
  }

  void act(support::Tracker& tracker) {
    switch (below(10)) {
      case 0:
      case 1:
      case 2:
      case 3:
        return key();
      case 4:
        return say("mousemove " + place() + " click " + std::to_string(1 + below(2)));
      case 5:
      case 6:
        return say("mousemove " + place() + " mousedown 3 mousemove " + place() + " mouseup 3");
      case 7:
        return below(4) == 0 ? tracker.fall_silent() : wave(tracker);
      case 8:
        return wave(tracker);
      default:
        return resize();
    }
  }

 private:
  unsigned below(unsigned bound) { return std::uniform_int_distribution<unsigned>(0, bound - 1)(random_); }
  double within(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  std::string place() { return std::to_string(below(kWidth)) + " " + std::to_string(below(kHeight)); }
  void say(const std::string& command) {
    std::fputs((command + "\n").c_str(), pipe_.get());
    std::fflush(pipe_.get());
  }

  void key() {
    static constexpr std::array kKeys{"F1", "F2", "F11", "m", "a", "r", "h", "p", "s",           "v",
                                      "c",  "g",  "b",   "j", "t", "1", "2", "3", "bracketleft", "bracketright",
                                      "t"};
    say("key " + std::string(kKeys.at(below(kKeys.size()))));
  }

  void wave(support::Tracker& tracker) {
    const glm::dvec3 hand(within(-1.0, 1.0), within(0.8, 1.8), within(1.0, 2.5));
    tracker.show(hand, {within(-1.5, 1.5), within(0.3, 2.5), within(-0.5, 0.8)}, below(16));
  }

  void resize() {
    if (below(4) == 0) {
      return say("windowunmap " + window_ + " sleep 0.1 windowmap " + window_ + " windowfocus " + window_);
    }
    say("windowsize " + window_ + " " + std::to_string(1 + below(2 * kWidth)) + " " +
        std::to_string(1 + below(2 * kHeight)));
  }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe_;
  std::mt19937 random_;
  std::string window_;
};

// MiB that a process holds.
double resident_mib(pid_t pid) {
  std::ifstream statm("/proc/" + std::to_string(pid) + "/statm");
  double all = 0, resident = 0;
  statm >> all >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

std::string servo_line(const std::string& said) {
  const std::size_t at = said.rfind("touchafm: servo: ");
  return at == std::string::npos ? "" : said.substr(at, said.find('\n', at) - at);
}

class SoakTest : public ::testing::Test {
 protected:
  std::vector<std::string> view() const {
    return {AFM_PROGRAM,    "view",
            "--size",       std::to_string(kWidth) + "x" + std::to_string(kHeight),
            "--frame-rate", "30",
            "--servo",      AFM_SERVO_MODE,
            "--wand",       "dtrack:" + tracker_.place(),
            "--head",       "dtrack:2",
            "--record",     folder_.file("sessions"),
            "--validate"};
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{2 * kWidth, 2 * kHeight};
  support::Tracker tracker_;
};

TEST_F(SoakTest, RandomHandsNeitherDisturbTheServoNorFillTheMemory) {
  const char* const wanted = std::getenv("AFM_SOAK_ACTIONS");
  const int actions = wanted == nullptr ? kFewActions : std::max(std::atoi(wanted), kFewActions);
  support::LiveProgram program(view(), display_.name());
  ASSERT_TRUE(program.says("Point at a sample")) << program.said();
  Hands hands(display_.name(), 20);
  std::vector<double> resident;
  const auto begin = std::chrono::steady_clock::now();
  for (int action = 0; action < actions; ++action) {
    hands.act(tracker_);
    std::this_thread::sleep_for(kPause);
    resident.push_back(resident_mib(program.pid()));
    ASSERT_GT(resident.back(), 0.0) << "it has ended after " << action << " actions: " << program.said();
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  program.signal(SIGTERM);
  ASSERT_EQ(program.ends(), 0) << program.said();
  EXPECT_THAT(program.said(), Not(HasSubstr("the servo ended unexpectedly")));
  EXPECT_THAT(servo_line(program.said()), HasSubstr("; 0 samples lost"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.file("sessions"))) {
    EXPECT_TRUE(load_session(entry.path().string()).has_value()) << entry.path();
  }

  const auto quarter = resident.begin() + static_cast<std::ptrdiff_t>(resident.size() / 4);
  const auto half = resident.begin() + static_cast<std::ptrdiff_t>(resident.size() / 2);
  const double early = *std::max_element(quarter, half), late = *std::max_element(half, resident.end());
  std::cout << actions << " actions in " << took.count() << " s; resident at 1/4 " << *quarter << " MiB, at the end "
            << resident.back() << " MiB, most before the middle " << early << ", after it " << late << "\n"
            << servo_line(program.said()) << "\n";
  EXPECT_LT(late, kMostGrowth * early);

  // beside it, as long an idle hand: a report, since the machine's own load decides here
  support::LiveProgram idle(view(), display_.name());
  ASSERT_TRUE(idle.says("Point at a sample")) << idle.said();
  std::this_thread::sleep_for(std::min(took, std::chrono::duration<double>(60.0)));
  idle.signal(SIGTERM);
  EXPECT_EQ(idle.ends(), 0) << idle.said();
  std::cout << "idle: " << servo_line(idle.said()) << "\n";
}

}  // namespace
}  // namespace afm::app
