// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

// Until this time of CLOCK_MONOTONIC, signals or not.
void sleep_until(std::int64_t deadline_ns) noexcept;

}  // namespace afm::haptics
