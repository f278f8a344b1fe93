// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/servo_rows.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "support/phrases.h"

namespace afm::exhibit {
namespace servo_rows_test {

using ::testing::HasSubstr;
using ::testing::Not;

std::string text(const scene::TipState& tip, const scene::ServoTiming& timing) {
  scene::SharedDevice device;
  std::copy_n("Omni", 4, device.name.begin());
  std::string all;
  for (const render::DataRow& row : servo_rows(tip, timing, device, test::english())) {
    all += row.name + ": " + row.value + " (" + row.source + ")\n";
  }
  return all;
}

TEST(ServoRows, TellLimitsScaleAndPunctualityWithTheirUnits) {
  scene::TipState tip;
  tip.safety.force_cap_n = 2.0;
  tip.safety.slew_limit_n_per_s = 500.0;
  tip.active.scale.hand_m_per_m = 0.050 / 14e-9;
  tip.active.scale.hand_n_per_n = 2.0 / 1.4e-9;
  tip.active.scale_mode = scene::ScaleMode::Compressed;
  scene::ServoTiming timing;
  timing.rate_hz = 1000.0;
  timing.ticks = 1000;
  timing.missed = 3;
  timing.wake_us[37] = 1000;  // bin from 37 to 38
  timing.wake_max_us = 38;
  const std::string all = text(tip, timing);
  EXPECT_THAT(all, HasSubstr("Scale of the hand: 3.57 mm/nm, 1.43 N/nN (compressed"));
  EXPECT_THAT(all, HasSubstr("Force limit: 2 N, 500 N/s (Omni)"));
  EXPECT_THAT(all, HasSubstr("Servo: 1000 Hz, not real-time"));
  EXPECT_THAT(all, HasSubstr("scheduling latency p99 38 \u00b5s, 3 of 1003 ticks missed"));
  EXPECT_THAT(all, Not(HasSubstr("Motors")));
}

TEST(ServoRows, TellOfWarmMotorsAndOfTheButtonThatMustBeHeld) {
  scene::TipState tip;
  tip.safety.motor_heat = 0.9;
  tip.safety.thermal_gain = 0.71;
  tip.dead_man = 1;
  tip.realtime = 1;
  scene::ServoTiming timing;
  timing.ticks = 1;
  const std::string all = text(tip, timing);
  EXPECT_THAT(all, HasSubstr("Motors: 90 % warm (force at 71 %)"));
  EXPECT_THAT(all, HasSubstr("only while Turn-On is held"));
  EXPECT_THAT(all, HasSubstr("Hz, real-time"));
}

}  // namespace servo_rows_test
}  // namespace afm::exhibit
