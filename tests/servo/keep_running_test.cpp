// SPDX-License-Identifier: Apache-2.0
// Invariant: a kiosk reopens a window that fails or hangs, kills one that will not end and leaves none behind
#include "servo/keep_running.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "core/whole_file.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace keep_running_test {

using ::testing::HasSubstr;

class KeepRunning : public ::testing::Test {
 protected:
  // Runs a program that notes each of its starts and then performs `end`.
  core::Result<void> run(const std::string& end, const KeepLimits& limits = {}) {
    return keep_running("/bin/sh", {"-c", "echo started >> " + starts() + "; " + end}, limits);
  }
  std::string starts() const { return folder_.file("starts"); }
  std::ptrdiff_t times() const {
    const std::string text = core::read_file(starts()).value();
    return std::count(text.begin(), text.end(), '\n');
  }
  support::ScratchFolder folder_;
};

TEST_F(KeepRunning, EndsWithAProgramThatEndsWell) {
  EXPECT_TRUE(run("exit 0"));
  EXPECT_EQ(times(), 1);
}

TEST_F(KeepRunning, StartsACrashedProgramAgain) {
  EXPECT_TRUE(run("test $(wc -l < " + starts() + ") -ge 3 && exit 0; kill -SEGV $$"));
  EXPECT_EQ(times(), 3);
}

TEST_F(KeepRunning, GivesUpOnOneThatCannotRun) {
  const auto done = run("exit 1");
  ASSERT_FALSE(done);
  EXPECT_EQ(times(), kMostRestarts + 1);
  EXPECT_THAT(done.error().message, HasSubstr("ended with exit code 1 6 times within a minute"));
}

// Silent after its first beat, or never heard; stopped, as only SIGKILL ends it then.
TEST_F(KeepRunning, KillsAndRestartsAProgramThatHangs) {
  const std::string third = "test $(wc -l < " + starts() + ") -ge 3 && exit 0; ";
  EXPECT_TRUE(run(third + "printf x >&3; kill -STOP $$", {.silence = std::chrono::milliseconds(200)}));
  EXPECT_EQ(times(), 3);
  std::filesystem::remove(starts());
  EXPECT_TRUE(run(third + "kill -STOP $$", {.start = std::chrono::milliseconds(200)}));
  EXPECT_EQ(times(), 3);
}

TEST_F(KeepRunning, WaitsForAProgramThatStartsSlowlyAndForOneThatBeats) {
  const KeepLimits limits{.silence = std::chrono::milliseconds(3000)};
  EXPECT_TRUE(run("sleep 3.5; for i in 1 2 3 4 5 6 7 8; do printf x >&3; sleep 0.5; done", limits));
  EXPECT_EQ(times(), 1);
}

// The keeper is a separate process, which is killed.
TEST_F(KeepRunning, LeavesNoProgramWithoutItsKeeper) {
  const pid_t keeper = ::fork();
  if (keeper == 0) {
    (void)run("echo $$ > " + folder_.file("pid.part") + "; mv " + folder_.file("pid.part") + " " + folder_.file("pid") +
              "; kill -STOP $$");
    ::_exit(1);
  }
  while (!std::filesystem::exists(folder_.file("pid"))) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const pid_t kept = std::stoi(core::read_file(folder_.file("pid")).value());
  EXPECT_EQ(::kill(kept, 0), 0);
  ::kill(keeper, SIGKILL);
  ::waitpid(keeper, nullptr, 0);
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  const auto is_gone = [&] {
    // an orphan that nobody has reaped yet is gone, too
    const auto status = core::read_file("/proc/" + std::to_string(kept) + "/stat");
    return !status || status->find(") Z ") != std::string::npos;
  };
  while (!is_gone() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(is_gone());
}

TEST(KeptBeat, EndsWithItsKeeperAndTakesNoOtherDescriptor) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  auto beat = KeptBeat::at(ends[1]);
  ASSERT_TRUE(beat) << beat.error().message;
  // nobody reads: beats are dropped, and none waits
  for (int i = 0; i < 1'000'000; ++i) ASSERT_TRUE(beat->beat());
  ::close(ends[0]);
  EXPECT_FALSE(beat->beat());
  EXPECT_EQ(KeptBeat::at(STDERR_FILENO).error().category, core::ErrorCategory::WrongUsage);
  EXPECT_EQ(KeptBeat::at(999).error().category, core::ErrorCategory::WrongUsage);
}

TEST_F(KeepRunning, DoesNotRepeatWhatIsRefused) {
  EXPECT_EQ(run("exit 2").error().category, core::ErrorCategory::WrongUsage);
  EXPECT_EQ(run("exit 3").error().category, core::ErrorCategory::BadInputFile);
  EXPECT_EQ(run("exit 4").error().category, core::ErrorCategory::DeviceMissing);
  EXPECT_EQ(times(), 3);
  EXPECT_FALSE(keep_running("/nowhere/touchafm", {}));
}

}  // namespace keep_running_test
}  // namespace afm::servo
