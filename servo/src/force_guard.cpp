// SPDX-License-Identifier: Apache-2.0
#include "force_guard.h"

#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <utility>

#include "core/farewell.h"

namespace afm::servo {

namespace {

constexpr int kBeatWakes = 2;
constexpr auto kLeavePatience = std::chrono::milliseconds(100);

}  // namespace

ForceGuard::End ForceGuard::watch(Beats beats, int dismissal) {
  for (int wakes = 0;; ++wakes) {
    if (beats == Beats::Yes && wakes % kBeatWakes == 0) {
      ::send(servo_, guard_letter::kBeat.data(), guard_letter::kBeat.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    }
    switch (hear(dismissal)) {
      case Heard::Dismissed:
        return End::Dismissed;
      case Heard::Gone:
        if (ending_) return End::InOrder;
        take_over();
        return End::Killed;
      case Heard::Message:
        continue;
      case Heard::Nothing:
        break;
    }
    if (!ending_ && ticked())
      silent_wakes_ = 0;
    else if (ending_ || ticking_)
      ++silent_wakes_;
    const int silent_ms = silent_wakes_ * times_.wake;
    if (!ending_ && silent_ms == times_.release) release();
    if (silent_ms < (ending_ ? times_.close : times_.kill)) continue;
    take_over();
    return ending_ ? End::NotClosed : End::Stuck;
  }
}

// Waits at most one wake-up's time.
ForceGuard::Heard ForceGuard::hear(int dismissal) {
  std::array<pollfd, 2> watched{
      {{.fd = servo_, .events = POLLIN, .revents = 0}, {.fd = dismissal, .events = POLLIN, .revents = 0}}};
  if (::poll(watched.data(), watched.size(), times_.wake) <= 0) return Heard::Nothing;
  if (watched[1].revents != 0) return Heard::Dismissed;
  core::FileDescriptor device;
  const auto text = letter_.read(servo_, {&device, 1});
  // ECONNRESET: the servo left beats unread. It comes once, before the letters that are still to be read.
  if (!text) return errno == EAGAIN || errno == EINTR || errno == ECONNRESET ? Heard::Nothing : Heard::Gone;
  if (*text == guard_letter::kEnd) {
    ending_ = true;
    silent_wakes_ = 0;
  } else if (text->front() == guard_letter::kPath && device.is_open()) {
    device_ = std::move(device);
    zero_size_ = text->size() - 1;
    std::copy(text->begin() + 1, text->end(), zero_.begin());
  }
  return Heard::Message;
}

bool ForceGuard::ticked() {
  const auto state = state_.tip_state();
  if (!state || state->tick == tick_) return false;
  tick_ = state->tick;
  return ticking_ = true;
}

void ForceGuard::release() const {
  if (device_.is_open()) ::send(device_.get(), zero_.data(), zero_size_, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void ForceGuard::take_over() const {
  release();
  ::syscall(SYS_pidfd_send_signal, process_, SIGKILL, nullptr, 0);
  // zero force again: the servo may have sent another one in between
  release();
  if (device_.is_open()) core::take_leave(device_.get(), kLeavePatience);
}

}  // namespace afm::servo
