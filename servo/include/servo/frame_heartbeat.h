// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/clock.h"
#include "servo/servo_client.h"

namespace afm::servo {

// Keeps a slow frame from looking like a dead one: tells the servo that the loop lives, as often as it is called, but
// for no longer than two seconds of one frame. A slow picture is no reason to let go of the hand, one that has stopped
// is. Made at the beginning of each frame.
class FrameHeartbeat {
 public:
  FrameHeartbeat(ServoClient& servo, const core::Clock& clock)
      : servo_(servo), clock_(clock), start_ns_(clock.now_ns()) {}

  void operator()() const;

 private:
  ServoClient& servo_;
  const core::Clock& clock_;
  std::int64_t start_ns_;
};

}  // namespace afm::servo
