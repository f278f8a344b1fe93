// SPDX-License-Identifier: Apache-2.0
#include "servo/watchdog.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "child_process.h"
#include "core/log.h"
#include "core/system_error.h"
#include "core/write_all.h"
#include "descriptor_letter.h"
#include "force_guard.h"
#include "haptics/realtime.h"

namespace afm::servo {

namespace {

constexpr int kWakeMs = 5;
constexpr int kFirstBeatMs = 5000;  // wait for the first beat; a busy machine takes seconds to start a program
constexpr int kWatchdogLeaveMs = 200;

// The process that created the socket pair; read before its number can have been reused.
core::FileDescriptor peer_of(int socket) {
  ucred peer{};
  socklen_t size = sizeof(peer);
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return {};
  return core::FileDescriptor(static_cast<int>(::syscall(SYS_pidfd_open, peer.pid, 0)));
}

void block_every_signal() {
  sigset_t every;
  ::sigfillset(&every);
  ::pthread_sigmask(SIG_SETMASK, &every, nullptr);
}

// Excludes this process from the kernel's memory killer, where the user may ask for that.
void ask_for_memory() {
  const core::FileDescriptor score(::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC));
  for (const std::string_view wish : {"-1000", "0"}) {
    if (score.is_open() && core::write_all(score.get(), wish) == 0) return;
  }
}

// Asks the user's systemd for a scope, so that a command or a lack of memory that ends the servo's scope leaves this
// process alone. Does not wait: without systemd there is none, and a busy session answers after seconds.
void ask_for_scope() {
  const char* folder = ::secure_getenv("XDG_RUNTIME_DIR");
  std::error_code error;
  if (folder == nullptr || !std::filesystem::exists(std::filesystem::path(folder) / "systemd", error)) return;
  std::string name = fmt::format("touchafm-guard-{}.scope", ::getpid()), process = std::to_string(::getpid());
  std::array<std::string, 16> words{"busctl",
                                    "--user",
                                    "--quiet",
                                    "--timeout=30",
                                    "call",
                                    "org.freedesktop.systemd1",
                                    "/org/freedesktop/systemd1",
                                    "org.freedesktop.systemd1.Manager",
                                    "StartTransientUnit",
                                    "ssa(sv)a(sa(sv))",
                                    std::move(name),
                                    "fail",
                                    "1",
                                    "PIDs",
                                    "au",
                                    "1"};
  std::array<char*, 19> raw{};
  std::size_t count = 0;
  for (std::string& word : words) raw[count++] = word.data();
  std::string none = "0";
  raw[count++] = process.data();
  raw[count++] = none.data();
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  sigset_t nothing;
  ::sigemptyset(&nothing);
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setsigmask(&attributes, &nothing);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t child = -1;
  ::posix_spawnp(&child, raw[0], &actions, &attributes, raw.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
}

}  // namespace

core::Result<std::unique_ptr<Watchdog>> Watchdog::start(const std::string& program, int segment) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot start the servo's watchdog: {}", core::system_error(errno)));
  }
  core::FileDescriptor ours(ends[0]);
  core::FileDescriptor theirs(ends[1]);
  const auto process =
      start_child(program, {"--segment", std::to_string(kInherited[0]), "--watch-servo", std::to_string(kInherited[1])},
                  {segment, theirs.get()});
  if (!process) return tl::unexpected(process.error());
  theirs.close();
  std::unique_ptr<Watchdog> watchdog(new Watchdog(*process, std::move(ours)));
  pollfd beat{.fd = watchdog->descriptor(), .events = POLLIN, .revents = 0};
  if (::poll(&beat, 1, kFirstBeatMs) == 1 && take_beat(watchdog->descriptor())) return watchdog;
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("the servo's watchdog {} did not start within {} s: no force without it; try again, "
                                   "or reinstall touchafm",
                                   program, kFirstBeatMs / 1000));
}

Watchdog::~Watchdog() {
  Letter().send(socket_.get(), guard_letter::kEnd);
  socket_.close();
  int status = 0;
  if (child_ended_within(process_, kWatchdogLeaveMs, status)) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

bool take_beat(int socket) noexcept {
  char beat = 0;
  const auto length = ::recv(socket, &beat, 1, MSG_DONTWAIT);
  return length > 0 || (length < 0 && (errno == EAGAIN || errno == EINTR));
}

void watch_servo(const core::FileDescriptor& servo, scene::SharedSegment& segment) {
  block_every_signal();
  const core::FileDescriptor process = peer_of(servo.get());
  ask_for_memory();
  ask_for_scope();
  ForceGuard guard(
      servo.get(), process.get(), segment,
      {.wake = kWakeMs, .release = kWatchdogReleaseMs, .kill = kWatchdogKillMs, .close = kWatchdogCloseMs});
  // the servo logs whatever is refused here too
  haptics::enter_realtime(haptics::kServoPriority, haptics::PageLock::Lock);
  switch (guard.watch(ForceGuard::Beats::Yes)) {
    case ForceGuard::End::Killed:
      core::log_line("watchdog: the servo was killed: zero force was sent to the device");
      break;
    case ForceGuard::End::Stuck:
      core::log_line("watchdog: the servo stopped responding: ended it, no force reaches the hand");
      break;
    case ForceGuard::End::NotClosed:
      core::log_line("watchdog: the device did not close: ended the servo, no force reaches the hand");
      break;
    case ForceGuard::End::InOrder:
    case ForceGuard::End::Dismissed:
      break;
  }
}

}  // namespace afm::servo
