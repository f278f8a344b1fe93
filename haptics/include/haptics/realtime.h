// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/clock.h"

namespace afm::haptics {

inline constexpr int kServoPriority = 80;    // priority below the kernel's own threads at 99
inline constexpr int kMonitorPriority = 79;  // notices the renderer's death while both cores are drawing

// Locking affects every page of the process, so a thread inside the renderer must not lock.
enum class PageLock { Lock, Leave };

struct RealtimeGrant {
  int priority = 0;  // priority under SCHED_FIFO; 0: refused
  bool pages_locked = false;
  std::vector<std::string> notes;  // refusals with reason and remedy, for the log

  bool realtime() const { return priority > 0 && pages_locked; }
};

// Requests SCHED_FIFO at `priority` for the calling thread, a timer slack of 1 ns, locked pages, and a prefaulted
// stack. Refusals are noted; none is fatal.
RealtimeGrant enter_realtime(int priority, PageLock lock);

// Nice value requested for the thread that draws.
inline constexpr int kDrawingNice = -10;

// Requests kDrawingNice for the calling thread and all threads that it starts later, such as those of a driver that
// draws on the processor. On a busy machine it otherwise gets an equal share, and a slow picture can cost the force.
// Not real-time: other programs still run. Returns whether it was granted; harmless if not.
bool favour_drawing();

// Line of /etc/security/limits.d that raises a limit for the current user.
std::string limit_fix(const char* item, const char* value);

// Sleeps until this time of CLOCK_MONOTONIC, despite signals.
void sleep_until(std::int64_t deadline_ns) noexcept;

// Sleeps likewise, but spins for the last `spin_ns`: the wake-up from sleep, some tens of microseconds, is then over
// before the deadline. The processor is busy meanwhile.
void sleep_then_spin_until(std::int64_t deadline_ns, std::int64_t spin_ns, const core::Clock& clock) noexcept;

}  // namespace afm::haptics
