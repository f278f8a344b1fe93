// SPDX-License-Identifier: Apache-2.0
#include "servo/renderer_monitor.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <utility>

#include "core/clock.h"
#include "core/log.h"
#include "haptics/realtime.h"
#include "haptics/servo_loop.h"
#include "servo/watchdog.h"

namespace afm::servo {

namespace {

constexpr int kBeatWaitMs = 20;  // twice the time between two beats

}  // namespace

RendererMonitor::RendererMonitor(haptics::ServoLoop& loop, core::FileDescriptor lifeline,
                                 const core::FileDescriptor& signals, int watchdog, ReleaseLink& link, Linger linger)
    : loop_(loop),
      lifeline_(std::move(lifeline)),
      signals_(signals),
      watchdog_(watchdog),
      link_(link),
      linger_(std::move(linger)),
      done_(::eventfd(0, EFD_CLOEXEC)),
      thread_([this] { watch(); }) {}

RendererMonitor::~RendererMonitor() {
  ::eventfd_write(done_.get(), 1);
  thread_.join();
}

// Counts waits rather than time, so that a pause of the whole machine does not count.
bool RendererMonitor::guarded(bool beat) noexcept {
  missed_beats_ = beat ? 0 : missed_beats_ + 1;
  return beat ? take_beat(watchdog_) : missed_beats_ * kBeatWaitMs < kWatchdogSilentMs;
}

RendererMonitor::Update RendererMonitor::wait_for(int descriptor, std::optional<int> milliseconds) {
  std::array<pollfd, 4> watched{{{.fd = descriptor, .events = POLLIN, .revents = 0},
                                 {.fd = signals_.get(), .events = POLLIN, .revents = 0},
                                 {.fd = done_.get(), .events = POLLIN, .revents = 0},
                                 {.fd = watchdog_, .events = POLLIN, .revents = 0}}};
  const core::MonotonicClock clock;
  const std::int64_t end_ns = clock.now_ns() + std::int64_t{1'000'000} * milliseconds.value_or(0);
  while (!milliseconds || clock.now_ns() <= end_ns) {
    if (::poll(watched.data(), watched.size(), kBeatWaitMs) < 0) continue;  // interrupted by a signal
    if (watched[2].revents != 0) return Update::Done;
    if (watched[1].revents != 0) return Update::Signal;
    if (!guarded(watched[3].revents != 0)) return Update::Unguarded;
    if (watched[0].revents != 0) return Update::Readable;
  }
  return Update::Nothing;
}

void RendererMonitor::watch() {
  // the servo has already logged whatever is refused here
  haptics::enter_realtime(haptics::kMonitorPriority, haptics::PageLock::Leave);
  for (;;) {
    const Update update = wait_for(lifeline_.get(), std::nullopt);
    if (update == Update::Done) return;
    if (update == Update::Signal || update == Update::Unguarded) {
      loop_.stop();
      if (update == Update::Unguarded) core::log_line("the servo's watchdog ended or is stopped: force released");
      return;
    }
    // a renderer never sends data here: any event is the end, or a reason to release the hand
    if (linger_.seconds <= 0 || !find_successor()) {
      loop_.renderer_died();
      return;
    }
    link_.set_renderer(lifeline_.get());
    loop_.renderer_returned();
  }
}

bool RendererMonitor::find_successor() {
  loop_.renderer_lost();
  const auto port = HandoverPort::open(linger_.program, linger_.scene_digest, linger_.arguments);
  if (!port) {
    core::log_line(port.error().message);
    return false;
  }
  core::log_line(fmt::format("the renderer died: the servo waits {} s for a new one", linger_.seconds));
  const core::MonotonicClock clock;
  const std::int64_t end_ns = clock.now_ns() + static_cast<std::int64_t>(1e9 * linger_.seconds);
  for (;;) {
    const std::int64_t left_ms = (end_ns - clock.now_ns()) / 1'000'000;
    if (wait_for(port->descriptor(), static_cast<int>(std::max<std::int64_t>(0, left_ms))) != Update::Readable) {
      return false;
    }
    switch (port->receive(linger_.segment, linger_.arguments, lifeline_)) {
      case HandoverPort::Answer::Stay:
        core::log_line("a new renderer took over the servo");
        return true;
      case HandoverPort::Answer::Leave:
        core::log_line("a new renderer requested different settings: shutting down");
        return false;
      case HandoverPort::Answer::Nobody:
        break;
    }
  }
}

}  // namespace afm::servo
