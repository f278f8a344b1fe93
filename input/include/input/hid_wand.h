// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "input/hid_report.h"
#include "input/orientation_filter.h"
#include "input/wand.h"

namespace afm::input {

// Assumed position of the hand that holds a wand without position tracking, and the direction straight ahead of it.
// Room frame; `forward` need not have unit length but must not be vertical.
struct HandPlace {
  glm::dvec3 position_m{0.0};
  glm::dvec3 forward{0.0, 0.0, -1.0};
};

// The wand that the reports of one HID device make: a pointer that pivots at the hand's place. A wand with a motion
// sensor points where it is turned; that of a cap or a stick is steered by it, as long as it does not move the scene.
// One thread.
class HidWand {
 public:
  HidWand(std::unique_ptr<HidDriver> driver, const HandPlace& place);

  // A report that came in at `now_ns`. False, and nothing changes: not a report of this device, or damaged.
  bool take(Bytes report, std::int64_t now_ns);

  // Output reports for the device, after every report that was taken.
  std::vector<std::vector<std::uint8_t>> take_answers() { return driver_->take_answers(); }

  // Once for every state that is published: steering goes on between the reports.
  WandState state(std::int64_t now_ns);

 private:
  void press(std::uint32_t buttons, std::int64_t now_ns);
  void steer(std::int64_t now_ns);
  void recenter();

  std::unique_ptr<HidDriver> driver_;
  HandPlace place_;
  double forward_rad_;  // of the forward direction, about +y from -z
  WandState state_;
  OrientationFilter filter_;
  double heading_offset_rad_ = 0.0;
  double yaw_rad_ = 0.0;  // of a steered ray, from straight ahead
  double pitch_rad_ = 0.0;
  std::int64_t steered_ns_ = 0;
  std::int64_t motion_ns_ = 0;
  std::int64_t grabbed_ns_ = 0;
  bool home_held_ = false;  // by the second of two quick presses of Grab
};

// Deflection of a cap or stick as a speed, -1 to 1: none within 10 % of the middle, then exponentially finer near it
// than at the stop.
double rate_response(double deflection);

}  // namespace afm::input
