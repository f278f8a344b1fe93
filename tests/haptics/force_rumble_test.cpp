// SPDX-License-Identifier: Apache-2.0
#include "devices/force_rumble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace force_rumble_test {

using afm::haptics::ForceRumble;
using afm::haptics::Rumble;

constexpr std::int64_t kTickNs = 1'000'000;

// Milliseconds for which the heavy motor shakes while the force follows `force_n` of the tick.
int shaken_ms(int ticks, const std::function<double(int)>& force_n) {
  ForceRumble rumble(2.0);
  int shaken = 0;
  for (int i = 0; i < ticks; ++i) shaken += rumble.step(force_n(i), (i + 1) * kTickNs).heavy > 0 ? 1 : 0;
  return shaken;
}

TEST(ForceRumble, ShakesShortlyForASnapInAndThreeTimesAsLongForAPullOff) {
  const int snap = shaken_ms(1000, [](int tick) { return tick < 500 ? 0.0 : 0.08; });
  EXPECT_GE(snap, 40);
  EXPECT_LE(snap, 44);
  // 500 N/s, as the governor lets it fall
  const int pull_off = shaken_ms(1000, [](int tick) {
    return tick < 400 ? 0.005 * tick : tick < 500 ? 2.0 : std::max(0.0, 2.0 - 0.5 * (tick - 500));
  });
  EXPECT_GE(pull_off, 120);
  EXPECT_LE(pull_off, 128);
}

TEST(ForceRumble, DoesNotTakeAHandOnASpringForAJump) {
  // 40 N/m at the fastest that a gamepad moves the hand
  EXPECT_EQ(shaken_ms(500, [](int tick) { return 40.0 * 0.1 * 0.001 * tick; }), 0);
}

TEST(ForceRumble, HumsInProportionAndIsSilentWithoutForce) {
  ForceRumble rumble(2.0);
  EXPECT_EQ(rumble.step(0.0, kTickNs).light, 0.0);
  EXPECT_EQ(rumble.step(0.01, 2 * kTickNs).light, 0.0);
  EXPECT_DOUBLE_EQ(rumble.step(1.0, 3 * kTickNs).light, 0.5 * ForceRumble::kHumShare);
  EXPECT_DOUBLE_EQ(rumble.step(50.0, 4 * kTickNs).light, ForceRumble::kHumShare);
}

}  // namespace force_rumble_test
