// SPDX-License-Identifier: Apache-2.0
#include "core/clock.h"

#include <ctime>

namespace afm::core {

std::int64_t MonotonicClock::now_ns() const noexcept {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace afm::core
