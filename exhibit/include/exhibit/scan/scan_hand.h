// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "exhibit/scan/live_scan.h"
#include "exhibit/words/phrases.h"
#include "physics/units.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// Metres of the hand per metre of the nanoworld, at the servo's current scale.
struct HandSize {
  double sideways = 1;
  double upwards = 1;

  bool operator==(const HandSize&) const = default;
};
HandSize hand_size(const scene::ActiveContact& active, physics::Length friction_period);

// Side of the largest square around the sample's origin, at most `side_m`, that the device can reach without touching
// its end-stops. Ignores axes along which the device hardly moves. `room_from_sample` as in SceneTransforms.
double reachable_side_m(const scene::SharedDevice& device, const std::array<double, 16>& room_from_sample,
                        const HandSize& size, double side_m);

// A scan that leads a hand at a speed that it can follow, and waits for it. One thread.
class LeadingScan {
 public:
  static constexpr double kHandMPerS = 0.06;    // speed along the lines, comparable to drawing with a ruler
  static constexpr double kReturnMPerS = 0.09;  // limit for any other motion, such as the return to the beginning
  static constexpr double kFarM = 0.015;        // distance between hand and scan at which the scan waits

  // Factor by which the lines are slowed down; 1 if their rate is slow enough.
  static double slow_motion(const LiveScan& scan, const HandSize& size);

  // Call once a frame: advances the scan as far as the hand has followed. `led`: the servo leads the hand, whose tip is
  // at `tip_m`, x and y in the sample's frame. Returns the message to the servo without its revision; `level`: at
  // constant height.
  scene::ScanLead advance(LiveScan& scan, const HandSize& size, bool led, const glm::dvec2& tip_m, bool level,
                          double seconds);

 private:
  glm::dvec3 path_m_{0.0};  // position on the scan's path, with which the hand is led
  bool led_before_ = false;
};

// Message for a hand that paints.
scene::ScanLead painting_lead(const LiveScan& scan);

// One line for the wall about the hand's next action. Empty after a fault, or while a painting hand still needs its
// force: the procedure's guidance explains that. `scan` must have a role for the hand.
std::optional<std::string> hand_guidance(const LiveScan& scan, const scene::TipState& tip, const Phrases& phrases);

}  // namespace afm::exhibit
