// SPDX-License-Identifier: Apache-2.0
#include "cluster/clock_offset.h"

#include <gtest/gtest.h>

namespace clock_offset_test {

using afm::cluster::ClockOffset;
using afm::cluster::ReadyMessage;

// A node whose clock is 500 ns ahead answers after 40 ns.
ReadyMessage answered(std::int64_t sent_ns, std::int64_t there_ns) {
  const std::int64_t came_ns = sent_ns + there_ns + 500;
  return {.frame_sent_ns = sent_ns, .frame_came_ns = came_ns, .ready_sent_ns = came_ns + 40};
}

TEST(ClockOffset, IsThatOfTheShortestRoundTrip) {
  ClockOffset clock;
  EXPECT_EQ(clock.ahead_ns(), 0);
  EXPECT_EQ(clock.add(answered(1000, 100), 1000 + 100 + 40 + 20), 120);
  EXPECT_EQ(clock.ahead_ns(), 540);  // half of the difference between both directions, its largest error
  EXPECT_EQ(clock.add(answered(2000, 8), 2000 + 8 + 40 + 10), 18);
  EXPECT_EQ(clock.ahead_ns(), 499);
  EXPECT_EQ(clock.add(answered(3000, 70), 3000 + 70 + 40 + 10), 80);
  EXPECT_EQ(clock.ahead_ns(), 499);
}

}  // namespace clock_offset_test
