// SPDX-License-Identifier: Apache-2.0
#include "app/bench/scheduling_latency.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/check.h"

namespace afm::app {

SchedulingLatency measure_wake_jitter(const core::Clock& clock, double rate_hz, double seconds) {
  AFM_CHECK(rate_hz > 0 && seconds > 0);
  const auto period_ns = static_cast<std::int64_t>(std::llround(1e9 / rate_hz));
  const auto duration_ns = static_cast<std::int64_t>(std::llround(1e9 * seconds));
  SchedulingLatency jitter;
  std::thread([&] {
    jitter.grant = haptics::enter_realtime(haptics::kServoPriority, haptics::PageLock::Leave);
    const std::int64_t end_ns = clock.now_ns() + duration_ns;
    for (std::int64_t deadline_ns = clock.now_ns() + period_ns; deadline_ns <= end_ns;) {
      haptics::sleep_until(deadline_ns);
      const std::int64_t late_ns = std::max<std::int64_t>(0, clock.now_ns() - deadline_ns);
      const std::int64_t missed = late_ns / period_ns;
      const auto late_us = static_cast<std::uint32_t>(std::min<std::int64_t>(late_ns / 1000, UINT32_MAX));
      ++jitter.ticks;
      jitter.missed += static_cast<std::uint64_t>(missed);
      jitter.max_us = std::max(jitter.max_us, late_us);
      ++jitter.late_us[std::min(late_us, scene::kHistogramBins - 1)];
      deadline_ns += (missed + 1) * period_ns;
    }
  }).join();
  return jitter;
}

}  // namespace afm::app
