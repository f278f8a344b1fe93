// SPDX-License-Identifier: Apache-2.0
#include "servo/watchdog.h"

#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <string_view>
#include <utility>

#include "child_process.h"
#include "core/farewell.h"
#include "core/system_error.h"
#include "descriptor_letter.h"
#include "haptics/realtime.h"

namespace afm::servo {

namespace {

using namespace std::string_view_literals;

// First byte of a message: its type.
constexpr char kPath = 'P';  // followed by the bytes of zero force
constexpr std::string_view kEnd = "E";

constexpr int kWakeMs = 5;
constexpr int kWatchdogLeaveMs = 200;
constexpr auto kLeavePatience = std::chrono::milliseconds(100);

// Logs without allocating.
void say(std::string_view line) {
  // a closed stderr cannot be reported
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
}

class Guard {
 public:
  Guard(const core::FileDescriptor& servo, scene::SharedSegment& segment)
      : servo_(servo), state_(segment.renderer_side()) {
    // the process that created the socket pair; read before its number can have been reused
    ucred peer{};
    socklen_t size = sizeof(peer);
    if (::getsockopt(servo.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0) {
      process_ = core::FileDescriptor(static_cast<int>(::syscall(SYS_pidfd_open, peer.pid, 0)));
    }
  }

  void watch() {
    for (;;) {
      switch (hear()) {
        case Heard::Gone:
          if (!ending_) take_over("touchafm: watchdog: the servo was killed: zero force was sent to the device\n"sv);
          return;
        case Heard::Message:
          continue;
        case Heard::Nothing:
          break;
      }
      if (!ending_ && ticked())
        silent_wakes_ = 0;
      else if (ending_ || ticking_)
        ++silent_wakes_;
      const int silent_ms = silent_wakes_ * kWakeMs;
      if (!ending_ && silent_ms == kWatchdogReleaseMs) release();
      if (silent_ms < (ending_ ? kWatchdogCloseMs : kWatchdogKillMs)) continue;
      take_over(ending_ ? "touchafm: watchdog: the device did not close: ended the servo, no force reaches the hand\n"sv
                        : "touchafm: watchdog: the servo stopped responding: ended it, no force reaches the hand\n"sv);
      return;
    }
  }

 private:
  enum class Heard { Nothing, Message, Gone };

  // Waits at most kWakeMs.
  Heard hear() {
    pollfd watched{.fd = servo_.get(), .events = POLLIN, .revents = 0};
    if (::poll(&watched, 1, kWakeMs) <= 0) return Heard::Nothing;
    core::FileDescriptor device;
    const auto text = letter_.read(servo_.get(), {&device, 1});
    if (!text) return errno == EAGAIN || errno == EINTR ? Heard::Nothing : Heard::Gone;
    if (*text == kEnd) {
      ending_ = true;
      silent_wakes_ = 0;
    } else if (text->front() == kPath && device.is_open()) {
      device_ = std::move(device);
      zero_size_ = text->size() - 1;
      std::copy(text->begin() + 1, text->end(), zero_.begin());
    }
    return Heard::Message;
  }

  bool ticked() {
    const auto state = state_.tip_state();
    if (!state || state->tick == tick_) return false;
    tick_ = state->tick;
    return ticking_ = true;
  }

  void release() const {
    if (device_.is_open()) ::send(device_.get(), zero_.data(), zero_size_, MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  void take_over(std::string_view line) const {
    release();
    if (process_.is_open()) ::syscall(SYS_pidfd_send_signal, process_.get(), SIGKILL, nullptr, 0);
    // zero force again: the servo may have sent another one in between
    release();
    if (device_.is_open()) core::take_leave(device_.get(), kLeavePatience);
    say(line);
  }

  const core::FileDescriptor& servo_;
  scene::RendererSide state_;
  core::FileDescriptor process_;
  core::FileDescriptor device_;
  std::array<char, kMostLetterBytes> zero_{};
  std::size_t zero_size_ = 0;
  Letter letter_;
  std::uint64_t tick_ = 0;
  int silent_wakes_ = 0;
  bool ticking_ = false;
  bool ending_ = false;
};

}  // namespace

core::Result<std::unique_ptr<Watchdog>> Watchdog::start(const std::string& program, int segment) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot start the servo's watchdog: {}", core::system_error(errno)));
  }
  core::FileDescriptor ours(ends[0]);
  const core::FileDescriptor theirs(ends[1]);
  const auto process =
      start_child(program, {"--segment", std::to_string(kInherited[0]), "--watch-servo", std::to_string(kInherited[1])},
                  {segment, theirs.get()});
  if (!process) return tl::unexpected(process.error());
  return std::unique_ptr<Watchdog>(new Watchdog(*process, std::move(ours)));
}

Watchdog::~Watchdog() {
  expect_end();
  socket_.close();
  int status = 0;
  if (child_ended_within(process_, kWatchdogLeaveMs, status)) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void Watchdog::offer(const haptics::ReleasePath& path) const noexcept {
  std::array<char, kMostLetterBytes> text{kPath};
  if (path.descriptor < 0 || path.zero.size() >= text.size()) return;
  std::copy(path.zero.begin(), path.zero.end(), text.begin() + 1);
  const std::array descriptor{path.descriptor};
  Letter().send(socket_.get(), {text.data(), 1 + path.zero.size()}, descriptor);
}

void Watchdog::expect_end() const noexcept { Letter().send(socket_.get(), kEnd); }

void watch_servo(const core::FileDescriptor& servo, scene::SharedSegment& segment) {
  Guard guard(servo, segment);
  // the servo logs whatever is refused here too
  haptics::enter_realtime(haptics::kServoPriority, haptics::PageLock::Lock);
  guard.watch();
}

}  // namespace afm::servo
