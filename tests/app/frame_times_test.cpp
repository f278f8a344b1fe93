// SPDX-License-Identifier: Apache-2.0
#include "app/display/frame_times.h"

#include <gtest/gtest.h>

namespace afm::app {
namespace frame_times_test {

constexpr std::int64_t kMs = 1'000'000;

TEST(FrameTimes, SaysNothingBeforeTheSecondFrame) {
  FrameTimes times;
  EXPECT_EQ(times.text(), "");
  times.shown(5 * kMs);
  EXPECT_EQ(times.text(), "");
}

TEST(FrameTimes, ReportRateAndPercentiles) {
  FrameTimes times;
  std::int64_t now = 0;
  times.shown(now);
  for (int i = 0; i < 999; ++i) times.shown(now += 20 * kMs - 1);
  times.shown(now += 120 * kMs);
  EXPECT_EQ(times.text(),
            "picture: 1001 frames, 49.8 per second; interval p50 20.0, p99 20.0, p99.9 20.0, max 120.0 ms");
}

TEST(FrameTimes, LeavesOutTheTimeInWhichNobodySeesTheWindow) {
  FrameTimes times;
  times.shown(0);
  times.shown(10 * kMs);
  times.hidden();
  times.shown(60'000 * kMs);
  times.shown(60'010 * kMs);
  EXPECT_EQ(times.text(), "picture: 4 frames, 100.0 per second; interval p50 10.0, p99 10.0, p99.9 10.0, max 10.0 ms");
}

TEST(FrameTimes, KnowsTheLongestHoweverLong) {
  FrameTimes times;
  times.shown(0);
  times.shown(5'000 * kMs);
  EXPECT_EQ(times.text(),
            "picture: 2 frames, 0.2 per second; interval p50 5000.0, p99 5000.0, p99.9 5000.0, max 5000.0 ms");
}

}  // namespace frame_times_test
}  // namespace afm::app
