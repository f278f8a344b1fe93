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

// Metres of hand for a metre of the nanoworld, on the scale that the servo has in use.
struct HandSize {
  double sideways = 1;
  double upwards = 1;

  bool operator==(const HandSize&) const = default;
};
HandSize hand_size(const scene::ActiveContact& active, physics::Length friction_period);

// The side of the largest square around the origin of the sample, no larger than `side_m`, over which the device can
// move a hand, clear of its end-stops. Axes along which a device hardly moves do not count. `room_from_sample` is as in
// SceneTransforms.
double reachable_side_m(const scene::SharedDevice& device, const std::array<double, 16>& room_from_sample,
                        const HandSize& size, double side_m);

// The scan that leads a hand: slow enough for it, and it waits for it. One thread.
class LeadingScan {
 public:
  static constexpr double kHandMPerS = 0.06;    // along the lines: as fast as one draws with a ruler
  static constexpr double kReturnMPerS = 0.09;  // at most, of any way, as from the end of an image to its beginning
  static constexpr double kFarM = 0.015;        // from the hand: the scan waits

  // How many times slower the lines are scanned than their rate says; 1 for those that are slow enough.
  static double slow_motion(const LiveScan& scan, const HandSize& size);

  // Once a frame: scans on, as far as the hand is there. `led`: the servo leads the hand, whose tip is at `tip_m` along
  // x and y of the sample. Returns what the servo is to know, without its revision; `level`: at one height.
  scene::ScanLead advance(LiveScan& scan, const HandSize& size, bool led, const glm::dvec2& tip_m, bool level,
                          double seconds);

 private:
  glm::dvec3 path_m_{0.0};  // of the hand
  bool led_before_ = false;
};

// The same for a hand that paints.
scene::ScanLead painting_lead(const LiveScan& scan);

// One line for the wall: what the hand can do now; nothing in a fault, or where a hand that paints must first get its
// force: the guidance of the procedure says how. `scan` has a part for it.
std::optional<std::string> hand_guidance(const LiveScan& scan, const scene::TipState& tip, const Phrases& phrases);

}  // namespace afm::exhibit
