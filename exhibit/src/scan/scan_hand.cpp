// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_hand.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "haptics/sample_axes.h"
#include "haptics/scaling.h"
#include "haptics/workspace_stop.h"

namespace afm::exhibit {

namespace {

constexpr double kClearM = 0.001;   // distance from an end-stop
constexpr double kHardlyM = 0.010;  // range to either side below which an axis is ignored
constexpr double kThereM = 1e-6;    // tolerance for the hand's position

}  // namespace

HandSize hand_size(const scene::ActiveContact& active, physics::Length friction_period) {
  const double upwards = active.scale.hand_m_per_m;
  return {.sideways = haptics::Scaling::lateral_m_per_m(active.scale_mode, upwards, friction_period.si),
          .upwards = upwards};
}

double reachable_side_m(const scene::SharedDevice& device, const std::array<double, 16>& room_from_sample,
                        const HandSize& size, double side_m) {
  haptics::SampleAxes axes;
  axes.set_orientation(room_from_sample);
  const glm::dvec3 x = axes.x(), y = glm::cross(axes.normal(), axes.x());
  double half_m = 0.5 * side_m * size.sideways;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double reach_m = std::min(device.workspace_max_m[axis], -device.workspace_min_m[axis]);
    const auto i = static_cast<int>(axis);
    const double share = std::abs(x[i]) + std::abs(y[i]);  // fraction of the half side, at a corner
    if (reach_m < kHardlyM || share < 1e-9) continue;
    half_m = std::min(half_m, (reach_m - haptics::WorkspaceStop::kDepthM - kClearM) / share);
  }
  return 2.0 * half_m / size.sideways;
}

double LeadingScan::slow_motion(const LiveScan& scan, const HandSize& size) {
  const double m_per_s = 2.0 * scan.subject().shown_side_m() * size.sideways * scan.choice().line_rate_hz;
  return std::max(1.0, m_per_s / kHandMPerS);
}

scene::ScanLead LeadingScan::advance(LiveScan& scan, const HandSize& size, bool led, const glm::dvec2& tip_m,
                                     bool level, double seconds) {
  const auto in_hand = [&](const glm::dvec3& place_m) {
    return glm::dvec3(size.sideways * place_m.x, size.sideways * place_m.y, level ? 0.0 : size.upwards * place_m.z);
  };
  if (led && led_before_) {
    const auto distance_m = [&] { return glm::distance(in_hand(scan.apex_m()), path_m_); };
    if (distance_m() < kThereM && glm::distance(size.sideways * tip_m, glm::dvec2(path_m_)) < kFarM) {
      scan.advance(seconds / slow_motion(scan, size));
    }
    const double most_m = kReturnMPerS * seconds, left_m = distance_m();
    path_m_ += std::min(1.0, most_m / std::max(left_m, kThereM)) * (in_hand(scan.apex_m()) - path_m_);
  } else {
    path_m_ = in_hand(scan.apex_m());
  }
  led_before_ = led;
  return {.apex_xy_m = {path_m_.x / size.sideways, path_m_.y / size.sideways},
          .height_m = path_m_.z / size.upwards,
          .hand = scene::ScanHand::Led};
}

scene::ScanLead painting_lead(const LiveScan& scan) {
  return {.gain_per_s = scan.choice().gain_per_s,
          .hand = scene::ScanHand::Scans,
          .feedback = scan.progress().hand->feedback ? 1U : 0U};
}

std::optional<std::string> hand_guidance(const LiveScan& scan, const scene::TipState& tip, const Phrases& phrases) {
  if (tip.servo_state == scene::ServoState::Fault) return std::nullopt;
  const bool force = tip.servo_state == scene::ServoState::Running;
  if (scan.is_painted()) {
    const bool other = (tip.level != 0) != scan.progress().hand->feedback;
    if (tip.phase != physics::Phase::Attached) {
      if (!force || tip.phase == physics::Phase::WaitForLift) return std::nullopt;
      return phrases[Phrase::ScanHandTouch];
    }
    return phrases[other && force ? Phrase::ScanHandLiftOnce : Phrase::ScanHandPaints];
  }
  if (tip.led != 0) return phrases[Phrase::ScanHandLed];
  if (tip.lead_lost != 0) return phrases[Phrase::ScanHandLost];
  return phrases[force ? Phrase::ScanHandHold : Phrase::ScanHandLift];
}

}  // namespace afm::exhibit
