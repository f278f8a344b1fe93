// SPDX-License-Identifier: Apache-2.0
#include "servo/servo_takeover.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "core/log.h"
#include "haptics/servo_settings.h"

namespace afm::servo {

namespace {

// Compares bit by bit, except the padding after a height field.
bool same_model(const scene::SharedModel& a, const scene::SharedModel& b) {
  constexpr std::size_t kWithoutPadding = offsetof(scene::SharedModel, height_fields);
  return std::memcmp(&a, &b, kWithoutPadding) == 0 &&
         std::equal(a.height_fields.begin(), a.height_fields.end(), b.height_fields.begin(),
                    [](const scene::SharedHeightField& one, const scene::SharedHeightField& other) {
                      return one.columns == other.columns && one.rows == other.rows &&
                             one.spacing_m == other.spacing_m && one.height_m == other.height_m;
                    });
}

}  // namespace

std::optional<TakenServo> take_waiting_servo(const scene::SharedModel& model, std::uint64_t scene_digest,
                                             const haptics::ServoSettings& settings, const std::string& haptic_device,
                                             const std::string& servo_program) {
  const std::vector<std::string> arguments = servo_arguments(settings, haptic_device);
  for (const auto& socket : find_waiting_servos(servo_program, scene_digest, arguments)) {
    auto waiting = visit_servo(socket);
    if (!waiting) continue;
    auto segment = scene::SharedSegment::attach(std::move(waiting->segment));
    if (!segment) core::log_line(segment.error().message);
    const bool fits = segment && settings.linger_s > 0 && segment->scene_digest() == scene_digest &&
                      waiting->arguments == arguments && same_model(segment->model(), model);
    if (fits) {
      core::log_line("taking over the servo of a renderer that died");
      return TakenServo{.segment = std::move(*segment), .servo = std::move(*waiting)};
    }
    core::log_line("the servo of a renderer that died has another scene or device: asking it to exit");
    waiting->lifeline.close();
    if (!process_ended_within(waiting->process, kLeaveMs)) {
      core::log_line("the servo of a renderer that died does not exit: it may still hold the device");
    }
  }
  return std::nullopt;
}

}  // namespace afm::servo
