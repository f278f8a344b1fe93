// SPDX-License-Identifier: Apache-2.0
// The live window for a long time under random but legal hands: keys, mouse, wands that are plugged in and pulled out,
// a tracker that falls silent, and the window's own changes, with Vulkan's calls validated. AFM_SOAK_ACTIONS says how
// many actions; without it a few, for every run of the tests. Run by umockdev-wrapper.
// Invariant: random input, hot-plugged wands and a silent tracker lose no sample and leak no memory
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
#include <map>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "servo/session_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/tracker.h"
#include "support/virtual_display.h"
#include "support/wand_port.h"

namespace afm::app {
namespace soak_test {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kWidth = 320, kHeight = 240;
constexpr int kFewActions = 200;
constexpr int kActionsAPlug = 50;     // at least, until the wand is plugged in, and pulled out again: two seconds
constexpr int kMostPlugChanges = 80;  // umockdev 0.17 ends a program that has opened 50 devices, though it closes them
constexpr auto kPause = std::chrono::milliseconds(40);
// Of the least that was held in the last quarter, above the greater of the two quarters before: windows come and go in
// all sizes, and a variant of a shader that is compiled late takes a few MiB. A picture of 320 x 240 that is lost with
// every change of the mode makes 75 MiB in a quarter of an hour's 90000 actions.
constexpr double kMostGrowthMib = 24.0;
constexpr auto kLongestIdle = std::chrono::minutes(10);

// Shared xdotool, tracker and wand for all actions.
class Hands {
 public:
  Hands(const std::string& display, unsigned seed, int actions)
      : pipe_(::popen(("DISPLAY=" + display + " xdotool -").c_str(), "w"), ::pclose),
        random_(seed),
        actions_a_plug_(std::max(kActionsAPlug, actions / kMostPlugChanges)) {
    const auto found = support::run_program("DISPLAY=" + display + " xdotool search --sync --name '^TouchAFM$'");
    window_ = found.out.substr(0, found.out.find('\n'));
  }

  void act(support::Tracker& tracker, support::WandPort& port) {
    if (++acted_ % actions_a_plug_ == 0) return change_plug(port);
    const unsigned choice = below(20);
    if (choice < 7) return key();
    if (choice < 9) return click();
    if (choice < 12) return drag();
    if (choice < 15 && port.plugged()) return turn_wand(port);
    if (choice < 17) return below(4) == 0 ? fall_silent(tracker) : move_head(tracker);
    return below(4) == 0 ? hide() : resize();
  }

  void plug(support::WandPort& port) {
    ++done_["wands plugged in"];
    second_kind_ = !second_kind_;
    if (second_kind_) return port.plug("054C:00000CE6", "DualSense");
    port.plug("256F:0000C635", "SpaceMouse Compact");
  }
  void unplug(support::WandPort& port) {
    ++done_["wands pulled out"];
    port.unplug();
  }

  const std::map<std::string, int>& done() const { return done_; }

 private:
  unsigned below(unsigned bound) { return std::uniform_int_distribution<unsigned>(0, bound - 1)(random_); }
  double within(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  std::string place() { return std::to_string(below(kWidth)) + " " + std::to_string(below(kHeight)); }
  void say(const std::string& command) {
    std::fputs((command + "\n").c_str(), pipe_.get());
    std::fflush(pipe_.get());
  }

  void key() {
    static constexpr std::array kKeys{"F1", "F2", "F11", "m", "a", "r", "h", "p",  "s",  "v", "c",
                                      "g",  "b",  "j",   "t", "1", "2", "3", "F7", "F8", "t", "v"};
    const std::string key = kKeys.at(below(kKeys.size()));
    ++done_[key == "v" || key == "c" ? "stereo modes" : "other keys"];
    say("key " + key);
  }
  void click() {
    ++done_["clicks"];
    say("mousemove " + place() + " click " + std::to_string(1 + below(2)));
  }
  void drag() {
    ++done_["drags"];
    say("mousemove " + place() + " mousedown 3 mousemove " + place() + " mouseup 3");
  }

  void change_plug(support::WandPort& port) { port.plugged() ? unplug(port) : plug(port); }
  void turn_wand(support::WandPort& port) {
    ++done_["reports of a wand"];
    port.send(second_kind_ ? dual_sense() : space_mouse());
  }
  std::vector<std::uint8_t> space_mouse() {
    if (below(2) == 0) return {3, static_cast<std::uint8_t>(below(4)), 0};
    std::vector<std::uint8_t> report{static_cast<std::uint8_t>(1 + below(2))};
    for (int axis = 0; axis < 3; ++axis) {
      const int reading = static_cast<int>(below(701)) - 350;
      report.push_back(static_cast<std::uint8_t>(reading & 0xFF));
      report.push_back(static_cast<std::uint8_t>((reading >> 8) & 0xFF));
    }
    return report;
  }
  // Held level, turned at up to half a turn a second, with some of its buttons.
  std::vector<std::uint8_t> dual_sense() {
    std::vector<std::uint8_t> report(64, 0);
    report[0] = 1;
    std::fill_n(report.begin() + 1, 4, std::uint8_t{128});
    report[8] = below(4) == 0 ? 0x20 : 0;
    report[9] = static_cast<std::uint8_t>(4 * below(4));
    for (std::size_t byte = 16; byte < 22; byte += 2) {
      const int reading = static_cast<int>(below(5761)) - 2880;
      report[byte] = static_cast<std::uint8_t>(reading & 0xFF);
      report[byte + 1] = static_cast<std::uint8_t>((reading >> 8) & 0xFF);
    }
    report[25] = 0x20;  // one g upwards
    return report;
  }

  void move_head(support::Tracker& tracker) {
    ++done_["heads moved"];
    tracker.show({0.5, 1.2, 1.8}, {0.0, 1.2, 0.0}, 0, {within(-1.0, 1.0), within(1.2, 1.9), within(0.8, 3.0)});
  }
  void fall_silent(support::Tracker& tracker) {
    ++done_["trackers silenced"];
    tracker.fall_silent();
  }

  void resize() {
    ++done_["resizes"];
    say("windowsize " + window_ + " " + std::to_string(1 + below(2 * kWidth)) + " " +
        std::to_string(1 + below(2 * kHeight)));
  }
  void hide() {
    ++done_["windows hidden"];
    say("windowunmap " + window_ + " sleep 0.1 windowmap " + window_ + " windowfocus " + window_);
  }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe_;
  std::mt19937 random_;
  int actions_a_plug_;
  std::string window_;
  std::map<std::string, int> done_;
  int acted_ = 0;
  bool second_kind_ = false;
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
  SoakTest() {
    // returns freed memory to the system, so that the resident memory is the memory in use; AddressSanitizer as well
    ::setenv("MALLOC_MMAP_THRESHOLD_", "65536", 1);
    ::setenv("MALLOC_TRIM_THRESHOLD_", "65536", 1);
    const char* const asan = std::getenv("ASAN_OPTIONS");
    ::setenv("ASAN_OPTIONS", (std::string(asan == nullptr ? "" : asan) + ":quarantine_size_mb=8").c_str(), 1);
  }

  std::vector<std::string> view() const {
    return {support::touchafm(),
            "view",
            "--size",
            std::to_string(kWidth) + "x" + std::to_string(kHeight),
            "--frame-rate",
            "30",
            "--servo",
            support::servo_mode(),
            "--wand",
            "hid",
            "--head",
            "dtrack:2@" + tracker_.place(),
            "--record",
            folder_.file("sessions"),
            "--validate"};
  }

  // The smallest resident memory in a quarter of the time.
  static double least(const std::vector<double>& resident, std::size_t quarter) {
    const auto at = [&](std::size_t q) {
      return resident.begin() + static_cast<std::ptrdiff_t>(resident.size() * q / 4);
    };
    return *std::min_element(at(quarter), at(quarter + 1));
  }

  // After all that the program still takes up a wand and lets it go.
  void expect_hot_plug(support::LiveProgram& program, Hands& hands) {
    if (port_.plugged()) hands.unplug(port_);
    program.skip_what_it_said();
    hands.plug(port_);
    EXPECT_NE(program.says_one_of({"wand: SpaceMouse Compact", "wand: DualSense"}), "") << program.said();
    hands.unplug(port_);
    EXPECT_TRUE(program.says("wand: unplugged")) << program.said();
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{2 * kWidth, 2 * kHeight};
  support::Tracker tracker_;
  support::WandPort port_;
};

TEST_F(SoakTest, RandomHandsNeitherDisturbTheServoNorFillTheMemory) {
  const char* const wanted = std::getenv("AFM_SOAK_ACTIONS");
  const int actions = wanted == nullptr ? kFewActions : std::max(std::atoi(wanted), kFewActions);
  support::LiveProgram program(view(), display_.name());
  ASSERT_TRUE(program.says("Choose a sample")) << program.said();
  Hands hands(display_.name(), 20, actions);
  std::vector<double> resident;
  const auto begin = std::chrono::steady_clock::now();
  for (int action = 0; action < actions; ++action) {
    hands.act(tracker_, port_);
    std::this_thread::sleep_for(kPause);
    resident.push_back(resident_mib(program.pid()));
    ASSERT_GT(resident.back(), 0.0) << "it has ended after " << action << " actions: " << program.said();
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  expect_hot_plug(program, hands);
  program.signal(SIGTERM);
  ASSERT_EQ(program.ends(), 0) << program.said();  // 1 with a message of the validation layer
  EXPECT_THAT(program.said(), Not(HasSubstr("the servo ended unexpectedly")));
  EXPECT_THAT(servo_line(program.said()), HasSubstr("; 0 samples lost"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.file("sessions"))) {
    EXPECT_TRUE(servo::load_session(entry.path().string()).has_value()) << entry.path();
  }

  std::cout << actions << " actions in " << took.count() << " s:";
  for (const auto& [kind, times] : hands.done()) std::cout << " " << times << " " << kind << ",";
  std::cout << " no validation message\nresident at 1/4 " << resident[resident.size() / 4] << " MiB, at 1/2 "
            << resident[resident.size() / 2] << ", at the end " << resident.back() << "; least of each quarter";
  for (std::size_t quarter = 0; quarter < 4; ++quarter) std::cout << " " << least(resident, quarter);
  std::cout << " MiB\n" << servo_line(program.said()) << "\n";
  EXPECT_LT(least(resident, 3), std::max(least(resident, 1), least(resident, 2)) + kMostGrowthMib);

  // for comparison an idle hand for as long: only reported, since the machine's own load decides here
  support::LiveProgram idle(view(), display_.name());
  ASSERT_TRUE(idle.says("Choose a sample")) << idle.said();
  std::this_thread::sleep_for(std::min(took, std::chrono::duration<double>(kLongestIdle)));
  idle.signal(SIGTERM);
  EXPECT_EQ(idle.ends(), 0) << idle.said();
  std::cout << "idle: " << servo_line(idle.said()) << "\n";
}

}  // namespace soak_test
}  // namespace afm::app
