// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/clock.h"
#include "servo/servo_client.h"

namespace afm::servo {

// Keeps the servo from mistaking a slow frame for a dead renderer: each call sends it a heartbeat, for at most two
// seconds per frame. A slow picture is no reason to release the hand; a stopped one is. Create one at the beginning of
// each frame.
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
