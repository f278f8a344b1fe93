// SPDX-License-Identifier: Apache-2.0
#include "exhibit/depth_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace afm::exhibit {

namespace {

// People read a depth as degrees that the eyes turn in, and what is drawn as millimetres on the wall.
std::string text_of(const scene::Disparity& disparity) {
  return fmt::format("{:+.2f}\u00b0 ({:+.0f} mm)", -glm::degrees(disparity.crossed_rad), disparity.uncrossed_m * 1e3);
}

}  // namespace

DepthReport report_depth(const render::DepthRange& range, double distance_m, double ipd_m, Relief relief) {
  DepthReport report{.nearest = scene::disparity_at(distance_m, ipd_m, range.nearest_m),
                     .farthest = scene::disparity_at(distance_m, ipd_m, range.farthest_m),
                     .text = {}};
  const double most = std::max(std::abs(report.nearest.crossed_rad), std::abs(report.farthest.crossed_rad));
  report.hard = most > scene::kComfortableDisparityRad;
  report.text = fmt::format("depth {:.2f} m to {:.2f} m from the eyes: {} to {}", range.nearest_m, range.farthest_m,
                            text_of(report.nearest), text_of(report.farthest));
  if (report.hard) {
    report.text += fmt::format(", beyond 1\u00b0: press {} or step back", relief == Relief::BringToWall ? "B" : "[");
  }
  // parallax at the far end never exceeds the eyes it is drawn for; who has closer eyes would have to turn them
  // outwards
  if (report.farthest.uncrossed_m > scene::kSmallestIpdM) {
    report.text +=
        fmt::format("; not for eyes less than {:.0f} mm apart", std::ceil(report.farthest.uncrossed_m * 1e3));
  }
  return report;
}

render::Label depth_label(const DepthReport& report, const scene::Screen& screen) {
  render::Label label{.text = report.text, .highlighted = report.hard, .placement = render::kNoPlacement};
  if (report.text.empty()) return label;
  const glm::dvec3 right = screen.lower_right - screen.lower_left, up = screen.upper_left - screen.lower_left;
  label.placement = {
      .lower_left_m = screen.lower_left + 0.01 * right + 0.01 * up, .right_m = 0.46 * right, .up_m = 0.03 * up};
  return label;
}

}  // namespace afm::exhibit
