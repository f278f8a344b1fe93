// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

namespace afm::haptics {

// Settings of the servo, from touchafm's options.
struct ServoSettings {
  double rate_hz = 1000.0;                                       // rate of the servo, 100 Hz to 10 kHz
  double max_force_n = std::numeric_limits<double>::infinity();  // operator's limit, at least kLeastForceLimitN
  bool dead_man = false;                                         // true: the force lasts only while Turn-On is held
  std::int64_t spin_ns = 0;  // time spent spinning at the end of every wait, for a punctual tick; 0 to half a period
  double linger_s = 0;       // time for which touchafm-servo keeps the device for another renderer after one has died
};

}  // namespace afm::haptics
