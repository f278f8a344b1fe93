// SPDX-License-Identifier: Apache-2.0
#include "servo/keep_running.h"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <deque>
#include <optional>
#include <thread>

#include "core/exit_code.h"
#include "core/interruption.h"
#include "core/log.h"
#include "core/system_error.h"

namespace afm::servo {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kLook = std::chrono::milliseconds(50);  // interval for checking the program and signals
constexpr auto kBeforeRestart = std::chrono::milliseconds(1000);
constexpr auto kMinute = std::chrono::minutes(1);

core::Result<pid_t> spawn(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> raw;
  raw.reserve(words.size() + 1);
  for (std::string& word : words) raw.push_back(word.data());
  raw.push_back(nullptr);
  pid_t pid = -1;
  const int error = ::posix_spawn(&pid, program.c_str(), nullptr, nullptr, raw.data(), environ);
  if (error == 0) return pid;
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("cannot start {} ({})", program, core::system_error(error)));
}

// Wait status of the process; passes on a signal to it once.
int wait_for(pid_t pid) {
  bool handed_on = false;
  for (;;) {
    int status = 0;
    if (::waitpid(pid, &status, WNOHANG) == pid) return status;
    if (core::interrupted() && !handed_on) {
      handed_on = true;
      ::kill(pid, SIGTERM);
    }
    std::this_thread::sleep_for(kLook);
  }
}

std::string end_of(int status) {
  return WIFSIGNALED(status) ? fmt::format("crashed with signal {}", WTERMSIG(status))
                             : fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

// Category of a failure that another start would repeat.
std::optional<core::ErrorCategory> refusal_of(int status) {
  if (!WIFEXITED(status)) return std::nullopt;
  switch (static_cast<core::ExitCode>(WEXITSTATUS(status))) {
    case core::ExitCode::WrongUsage:
      return core::ErrorCategory::WrongUsage;
    case core::ExitCode::BadInputFile:
      return core::ErrorCategory::BadInputFile;
    case core::ExitCode::DeviceMissing:
      return core::ErrorCategory::DeviceMissing;
    default:
      return std::nullopt;
  }
}

}  // namespace

core::Result<void> keep_running(const std::string& program, const std::vector<std::string>& arguments) {
  const core::OrderlyEnd by_itself;
  std::deque<Clock::time_point> failures;
  for (;;) {
    const auto pid = spawn(program, arguments);
    if (!pid) return tl::unexpected(pid.error());
    const int status = wait_for(*pid);
    if (core::interrupted() || (WIFEXITED(status) && WEXITSTATUS(status) == 0)) return {};
    if (const auto refused = refusal_of(status))
      return core::failure(*refused, "the window could not be opened; see above");
    const Clock::time_point now = Clock::now();
    failures.push_back(now);
    while (now - failures.front() > kMinute) failures.pop_front();
    if (failures.size() > static_cast<std::size_t>(kMostRestarts)) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("the window {} {} times within a minute; see its last messages above",
                                       end_of(status), failures.size()));
    }
    core::log_line(fmt::format("the window {}; reopening it", end_of(status)));
    std::this_thread::sleep_for(kBeforeRestart);
  }
}

}  // namespace afm::servo
