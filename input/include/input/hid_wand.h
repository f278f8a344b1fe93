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

// Wand made from the reports of one HID device: a pointer that pivots at the position of the hand. A wand with a motion
// sensor points in its own direction; a cap or stick steers the ray while it does not move the scene. One thread.
class HidWand {
 public:
  HidWand(std::unique_ptr<HidDriver> driver, const HandPlace& place);

  // Processes a report received at `now_ns`. Returns false and changes nothing if it is not a report of this device, or
  // damaged.
  bool take(Bytes report, std::int64_t now_ns);

  // Output reports for the device; send them after every accepted report.
  std::vector<std::vector<std::uint8_t>> take_answers() { return driver_->take_answers(); }

  // Call once for every published state: steering continues between the reports.
  WandState state(std::int64_t now_ns);

 private:
  void press(std::uint32_t buttons, std::int64_t now_ns);
  void steer(std::int64_t now_ns);
  void recenter();

  std::unique_ptr<HidDriver> driver_;
  HandPlace place_;
  double forward_rad_;  // forward direction as an angle about +y from -z
  WandState state_;
  OrientationFilter filter_;
  double heading_offset_rad_ = 0.0;
  double yaw_rad_ = 0.0;  // yaw of the steered ray, from straight ahead
  double pitch_rad_ = 0.0;
  std::int64_t steered_ns_ = 0;
  std::int64_t motion_ns_ = 0;
  std::int64_t grabbed_ns_ = 0;
  bool home_held_ = false;  // true: second of two quick presses of Grab
};

// Speed, -1 to 1, for the deflection of a cap or stick: zero within 10 % of the middle, then exponential, finer near
// the middle than at the stop.
double rate_response(double deflection);

}  // namespace afm::input
