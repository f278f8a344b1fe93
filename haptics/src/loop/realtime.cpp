// SPDX-License-Identifier: Apache-2.0
#include "haptics/realtime.h"
#include "core/system_error.h"

#include <fmt/core.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <ctime>

namespace afm::haptics {

namespace {

// Touches more stack than a tick uses, so that no tick has a page fault there.
void prefault_stack() {
  constexpr std::size_t kBytes = 256 * 1024;
  constexpr std::size_t kPage = 4096;
  std::array<char, kBytes> stack;
  volatile char* bytes = stack.data();
  for (std::size_t i = 0; i < kBytes; i += kPage) bytes[i] = 0;
}

rlim_t limit_of(__rlimit_resource resource) {
  rlimit limit{};
  return ::getrlimit(resource, &limit) == 0 ? limit.rlim_cur : 0;
}

}  // namespace

std::string limit_fix(const char* item, const char* value) {
  return fmt::format("echo \"$(id -un) - {} {}\" | sudo tee -a /etc/security/limits.d/touchafm.conf, then log in again",
                     item, value);
}

RealtimeGrant enter_realtime(int priority, PageLock lock) {
  RealtimeGrant grant;
  sched_param parameters{};
  parameters.sched_priority = priority;
  if (const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters); error == 0) {
    grant.priority = priority;
  } else {
    grant.notes.push_back(fmt::format("not real-time: SCHED_FIFO {} was refused ({}, the limit is {}); {}", priority,
                                      core::system_error(error), limit_of(RLIMIT_RTPRIO), limit_fix("rtprio", "80")));
  }
  if (::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL) != 0) {
    grant.notes.push_back(fmt::format("coarse timers: a slack of 1 ns was refused ({})", core::system_error(errno)));
  }
  if (lock == PageLock::Lock) {
    grant.pages_locked = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
    if (!grant.pages_locked) {
      grant.notes.push_back(fmt::format("not real-time: locking the pages was refused ({}, the limit is {} KiB); {}",
                                        core::system_error(errno), limit_of(RLIMIT_MEMLOCK) / 1024,
                                        limit_fix("memlock", "unlimited")));
    }
  }
  prefault_stack();
  return grant;
}

bool favour_drawing() { return ::setpriority(PRIO_PROCESS, 0, kDrawingNice) == 0; }

void sleep_until(std::int64_t deadline_ns) noexcept {
  const timespec deadline{.tv_sec = deadline_ns / 1'000'000'000, .tv_nsec = deadline_ns % 1'000'000'000};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

void sleep_then_spin_until(std::int64_t deadline_ns, std::int64_t spin_ns, const core::Clock& clock) noexcept {
  sleep_until(deadline_ns - spin_ns);
  while (clock.now_ns() < deadline_ns) {
  }
}

}  // namespace afm::haptics
