// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/clock.h"
#include "haptics/realtime.h"
#include "scene/shared/shared_blocks.h"

namespace afm::app {

// Wake-up latency of an idle thread on this machine: a lower bound for the servo's.
struct SchedulingLatency {
  haptics::RealtimeGrant grant;  // scheduling granted to the thread; its pages were not locked
  std::uint64_t ticks = 0;       // number of deadlines with a wake-up
  std::uint64_t missed = 0;      // number of deadlines that passed while an earlier one was late
  std::uint32_t max_us = 0;
  std::array<std::uint32_t, scene::kHistogramBins> late_us{};  // bins of 1 us; the last holds everything longer
};

// Sleeps to absolute deadlines at `rate_hz` for `seconds`, in a separate thread that requests the servo's priority. The
// caller waits. Must not be called in a servo tick.
SchedulingLatency measure_wake_jitter(const core::Clock& clock, double rate_hz, double seconds);

}  // namespace afm::app
