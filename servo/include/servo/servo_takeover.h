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

// Takes over a servo that has been waiting since its renderer died, if it fits this renderer: the same scene,
// materials, device and `settings`, which must ask for lingering too. Any other waiting servo is asked to exit, and
// waited for, because it may hold the device.
std::optional<TakenServo> take_waiting_servo(const scene::SharedModel& model, std::uint64_t scene_digest,
                                             const haptics::ServoSettings& settings, const std::string& haptic_device,
                                             const std::string& servo_program);

}  // namespace afm::servo
