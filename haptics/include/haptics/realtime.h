// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/clock.h"

namespace afm::haptics {

inline constexpr int kServoPriority = 80;    // below the kernel's own threads at 99
inline constexpr int kMonitorPriority = 79;  // hears of the renderer's death even when both cores draw

// Locking reaches every page of the process, so a thread inside the renderer leaves them alone.
enum class PageLock { Lock, Leave };

struct RealtimeGrant {
  int priority = 0;  // SCHED_FIFO, 0: refused
  bool pages_locked = false;
  std::vector<std::string> notes;  // what was refused, why, and what to do; for the log

  bool realtime() const { return priority > 0 && pages_locked; }
};

// Asks for SCHED_FIFO at `priority` for the calling thread, a timer slack of 1 ns, locked pages, and a stack whose next
// pages are there already. Everything that is refused is noted; nothing is fatal.
RealtimeGrant enter_realtime(int priority, PageLock lock);

// The line that raises a limit of /etc/security/limits.d for the person who runs it.
std::string limit_fix(const char* item, const char* value);

// Until this time of CLOCK_MONOTONIC, signals or not.
void sleep_until(std::int64_t deadline_ns) noexcept;

// The same, with the last `spin_ns` spent awake: the wake-up from the sleep, some tens of microseconds, then lies
// before the deadline. The processor is busy for as long.
void sleep_then_spin_until(std::int64_t deadline_ns, std::int64_t spin_ns, const core::Clock& clock) noexcept;

}  // namespace afm::haptics
