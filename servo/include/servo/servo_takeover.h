// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scene/shared/shared_segment.h"
#include "servo/servo_handover.h"

namespace afm::servo {

struct TakenServo {
  scene::SharedSegment segment;
  WaitingServo servo;
};

// The servo that waits since its renderer died, if this renderer can go on with it: it is of the same scene, feels the
// same materials, runs as `settings` say, which must want to linger too, and holds the same device. Any other is asked
// to exit, and waited for, because it may hold the device.
std::optional<TakenServo> take_waiting_servo(const scene::SharedModel& model, std::uint64_t scene_digest,
                                             const haptics::ServoSettings& settings, const std::string& haptic_device,
                                             const std::string& servo_program);

}  // namespace afm::servo
