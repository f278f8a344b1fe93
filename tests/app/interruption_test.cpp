// SPDX-License-Identifier: Apache-2.0
// Invariant: SIGINT, SIGTERM and SIGHUP end every command soon and leave nothing half-written
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "core/whole_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

// SIGINT, SIGTERM and SIGHUP, at moments when the program computes, draws, starts and writes. No hand waits here, so
// that the time is printed and the processor time judged, which a busy machine does not lengthen.
namespace afm {
namespace interruption_test {

using std::chrono::milliseconds;
using testing::EndsWith;
namespace fs = std::filesystem;

// Limit for the program and its children, from the signal to their end: far less than the work that was left.
constexpr auto kMostProcessorTime = milliseconds(2000);

// Waits until the program has blocked SIGTERM to handle it itself; under a sanitizer that takes 0.2 s. Before it is
// touchafm, the C library blocks all signals of its process for a moment, within fork().
bool has_begun(const support::LiveProgram& program) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::chrono::steady_clock::now() < end) {
    const auto status = core::read_file(fmt::format("/proc/{}/status", program.pid()));
    const bool runs = status && status->starts_with("Name:\ttouchafm\n");
    const std::size_t held = runs ? status->find("SigBlk:") : std::string::npos;
    if (held != std::string::npos && ((std::stoull(status->substr(held + 7), nullptr, 16) >> (SIGTERM - 1)) & 1) != 0) {
      return true;
    }
    std::this_thread::sleep_for(milliseconds(1));
  }
  return false;
}

milliseconds processor_time_of_children_that_ended() {
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  return milliseconds(1000 * (used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                      (used.ru_utime.tv_usec + used.ru_stime.tv_usec) / 1000);
}

// Processor time of a program, its children, and those of them that have ended.
milliseconds processor_time(pid_t program) {
  const auto stat = core::read_file(fmt::format("/proc/{}/stat", program));
  if (!stat) return {};
  std::istringstream words(stat->substr(stat->rfind(')') + 1));
  std::string word;
  for (int before_utime = 3; before_utime < 14; ++before_utime) words >> word;
  std::int64_t ticks = 0;
  for (std::int64_t one = 0, i = 0; i < 4 && words >> one; ++i) ticks += one;  // utime, stime, cutime, cstime
  milliseconds sum(1000 * ticks / ::sysconf(_SC_CLK_TCK));
  std::error_code ended;
  for (const auto& thread : fs::directory_iterator(fmt::format("/proc/{}/task", program), ended)) {
    std::istringstream children(core::read_file((thread.path() / "children").string()).value_or(""));
    for (pid_t child = 0; children >> child;) sum += processor_time(child);
  }
  return sum;
}

struct Ended {
  int exit_code = -1;
  std::string said;
};

// The end of the program, which takes a minute at most.
Ended interrupt(support::LiveProgram& program, int number) {
  const milliseconds others = processor_time_of_children_that_ended(), before = processor_time(program.pid());
  const auto begin = std::chrono::steady_clock::now();
  program.signal(number);
  Ended ended{.exit_code = program.ends().value_or(-1), .said = program.said()};
  const auto took = std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begin);
  const milliseconds used = processor_time_of_children_that_ended() - others - before;
  std::printf("ended %lld ms after signal %d (goal 500 ms), with %lld ms of processor time\n",
              static_cast<long long>(took.count()), number, static_cast<long long>(used.count()));
  EXPECT_LE(used.count(), kMostProcessorTime.count());
  return ended;
}

std::string wall_of_two_machines() {
  return R"([[screen]]
name = "powerwall"
lower_left = [-1.524, 0.400, 0.0]
lower_right = [1.524, 0.400, 0.0]
upper_left = [-1.524, 2.686, 0.0]
[[node]]
name = "left"
host = "127.0.0.1"
[[viewer]]
name = "visitor"
ipd = "63 mm"
sweet_spot = [0.0, 1.65, 2.5]
[[output]]
name = "output 0"
screen = "powerwall"
mode = "mono"
rect = [0, 0, 96, 72]
[[output]]
name = "output 1"
screen = "powerwall"
node = "left"
mode = "mono"
rect = [96, 0, 96, 72]
)";
}

class InterruptedDemonstration : public testing::TestWithParam<milliseconds> {};

TEST(Interruption, OfASweepLeavesNoFile) {
  std::vector<std::string> mode{"--material", "mica"};
  const auto interrupted = [&](int number) {
    const support::ScratchFolder folder;
    std::vector<std::string> words{support::touchafm(), "curve"};
    words.insert(words.end(), mode.begin(), mode.end());
    words.insert(words.end(), {"--sweep", "tip-radius=1nm:100nm:1000000", "--out", folder.file("sweep.csv")});
    support::LiveProgram sweep(words, "");
    EXPECT_TRUE(sweep.says("sweep: "));
    const Ended ended = interrupt(sweep, number);
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.said, EndsWith("touchafm: interrupted\n"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
  };
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) interrupted(number);
  mode.insert(mode.end(), {"--mode", "tapping", "--free-amplitude", "20nm", "--resonance", "300kHz", "--quality-factor",
                           "400", "--spring-constant", "40N/m"});
  interrupted(SIGINT);
}

TEST(Interruption, ByHangupIsNoneUnderNohup) {
  const support::ScratchFolder folder;
  support::LiveProgram sweep({"/usr/bin/nohup", support::touchafm(), "curve", "--material", "mica", "--sweep",
                              "tip-radius=1nm:100nm:1000000", "--out", folder.file("sweep.csv")},
                             "");
  ASSERT_TRUE(sweep.says("sweep: ")) << sweep.said();
  sweep.signal(SIGHUP);
  ASSERT_TRUE(sweep.says("sweep: ")) << "it goes on: " << sweep.said();
  EXPECT_EQ(interrupt(sweep, SIGTERM).exit_code, 1);
}

TEST(Interruption, OfAnExaminationOfAWallIsItsEnd) {
  const support::ScratchFolder folder;
  const std::string wall = folder.write("wall.toml", wall_of_two_machines());
  const auto interrupted = [&](int number) {
    support::LiveProgram doctor({support::touchafm(), "doctor", "--cluster", wall, "--domain", "229"}, "");
    EXPECT_TRUE(has_begun(doctor)) << doctor.said();
    std::this_thread::sleep_for(milliseconds(700));  // time in which it listens, or asks the nodes
    const Ended ended = interrupt(doctor, number);
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.said, EndsWith("touchafm: interrupted\n"));
  };
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) interrupted(number);
}

TEST(Interruption, OfAScanLeavesNoFile) {
  const support::ScratchFolder folder;
  support::LiveProgram scan({support::touchafm(), "scan", "--material", "mica", "--size", "500nm", "--pixels", "4096",
                             "--rate", "0.01Hz", "--out", folder.file("image.gwy")},
                            "");
  EXPECT_TRUE(scan.says("beyond its rim the image is level"));
  const Ended ended = interrupt(scan, SIGINT);
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.said, EndsWith("touchafm: interrupted\n"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// Interrupted while it loads, starts its servo, renders a cycle, and draws the pictures of the report.
TEST_P(InterruptedDemonstration, LeavesNoFile) {
  const support::ScratchFolder folder;
  support::LiveProgram demo({support::touchafm(), "demo", "--out", folder.file("out"), "--material", "mica"}, "");
  EXPECT_TRUE(has_begun(demo)) << demo.said();
  std::this_thread::sleep_for(GetParam());
  const Ended ended = interrupt(demo, SIGTERM);
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.said, testing::HasSubstr("touchafm: interrupted\n"));
  EXPECT_TRUE(!fs::exists(folder.file("out")) || fs::is_empty(folder.file("out")));
}
INSTANTIATE_TEST_SUITE_P(After, InterruptedDemonstration,
                         testing::Values(milliseconds(100), milliseconds(800), milliseconds(2500), milliseconds(6000)),
                         [](const auto& test) { return std::to_string(test.param.count()) + "ms"; });

TEST(Interruption, OfAViewThatStartsIsItsEnd) {
  const support::VirtualDisplay display(64, 64);
  for (const char* line : {"drawing 64 x 64", "Choose a sample"}) {
    support::LiveProgram view({support::touchafm(), "view", "--size", "64x64", "--frame-rate", "12"}, display.name());
    EXPECT_TRUE(view.says(line)) << view.said();
    const Ended ended = interrupt(view, SIGTERM);
    EXPECT_EQ(ended.exit_code, 0) << ended.said;
  }
}

// The servo of a program: a child of that name.
pid_t servo_of(pid_t program) {
  const auto children = core::read_file(fmt::format("/proc/{0}/task/{0}/children", program));
  std::istringstream numbers(children.value_or(""));
  for (pid_t child = 0; numbers >> child;) {
    if (core::read_file(fmt::format("/proc/{}/comm", child)).value_or("") == "touchafm-servo\n") return child;
  }
  return -1;
}

// A servo that is suspended for 60 ms releases the hand; the demonstration lifts, repeats the cycle and reports every
// jump.
TEST(StalledServo, OfADemonstrationFeelsTheWholeCycleAgain) {
  const support::ScratchFolder folder;
  support::LiveProgram demo({support::touchafm(), "demo", "--material", "gold", "--eye-width", "64", "--hand-speed",
                             "100mm/s", "--out", folder.file("out")},
                            "");
  ASSERT_TRUE(demo.says("jump to contact")) << demo.said();
  const pid_t servo = servo_of(demo.pid());
  ASSERT_GT(servo, 0);
  ::kill(servo, SIGSTOP);
  std::this_thread::sleep_for(milliseconds(60));
  ::kill(servo, SIGCONT);
  ASSERT_TRUE(demo.says("the servo released the hand")) << demo.said();
  ASSERT_TRUE(demo.says("jump to contact")) << demo.said();
  ASSERT_TRUE(demo.says("jump off contact")) << demo.said();
  EXPECT_EQ(interrupt(demo, SIGINT).exit_code, 1);
}

}  // namespace interruption_test
}  // namespace afm
