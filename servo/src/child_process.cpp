// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "core/file_descriptor.h"
#include "core/system_error.h"

namespace afm::servo {

namespace {

constexpr int kFirstClosed = kInherited.back() + 1;

core::Error spawn_error(const std::string& program, int error) {
  return {core::ErrorCategory::Failed,
          fmt::format("cannot start {}: {}; reinstall touchafm, or build the targets "
                      "touchafm-servo and touchafm-guard: all of its programs belong in one "
                      "folder",
                      program, core::system_error(error))};
}

// Owns the attributes and actions of posix_spawn.
class SpawnPlan {
 public:
  SpawnPlan() {
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
  }

  int fill(int first, int second) {
    sigset_t none;
    ::sigemptyset(&none);
    for (const int error :
         {::posix_spawn_file_actions_adddup2(&actions, first, kInherited[0]),
          ::posix_spawn_file_actions_adddup2(&actions, second, kInherited[1]),
          ::posix_spawn_file_actions_addclosefrom_np(&actions, kFirstClosed),
          ::posix_spawnattr_setsigmask(&attributes, &none), ::posix_spawnattr_setpgroup(&attributes, 0),
          ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP)}) {
      if (error != 0) return error;
    }
    return 0;
  }

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

// Copies a descriptor to a number that does not collide with the child's.
core::FileDescriptor out_of_the_way(int descriptor) {
  return core::FileDescriptor(::fcntl(descriptor, F_DUPFD_CLOEXEC, kFirstClosed));
}

}  // namespace

core::Result<pid_t> start_child(const std::string& program, std::vector<std::string> arguments,
                                const std::array<int, 2>& descriptors) {
  const core::FileDescriptor first = out_of_the_way(descriptors[0]);
  const core::FileDescriptor second = out_of_the_way(descriptors[1]);
  if (!first.is_open() || !second.is_open()) return tl::unexpected(spawn_error(program, errno));
  std::string name = program;
  std::vector<char*> argv{name.data()};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);

  SpawnPlan plan;
  pid_t child = -1;
  int error = plan.fill(first.get(), second.get());
  if (error == 0) error = ::posix_spawn(&child, program.c_str(), &plan.actions, &plan.attributes, argv.data(), environ);
  if (error != 0) return tl::unexpected(spawn_error(program, error));
  return child;
}

bool child_ended_within(pid_t child, int milliseconds, int& status) noexcept {
  for (int waited = 0;; ++waited) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return true;
    if (ended < 0 && errno == ECHILD) {
      status = W_EXITCODE(1, 0);  // assumed failure of a child that was reaped elsewhere
      return true;
    }
    if (waited >= milliseconds) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace afm::servo
