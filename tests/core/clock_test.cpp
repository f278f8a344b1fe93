// SPDX-License-Identifier: Apache-2.0
#include "core/clock.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <ctime>

namespace afm::core {
namespace clock_test {

std::int64_t kernel_ns() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_nsec + 1'000'000'000 * std::int64_t{time.tv_sec};
}

// However long the reading takes: the kernel is asked before and after.
TEST(MonotonicClock, IsTheKernels) {
  const MonotonicClock clock;
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t before = kernel_ns();
    const std::int64_t now = clock.now_ns();
    EXPECT_LE(before, now);
    EXPECT_LE(now, kernel_ns());
  }
}

}  // namespace clock_test
}  // namespace afm::core
