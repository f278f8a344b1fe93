// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/depth_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace afm::exhibit {

namespace {

// The convergence in degrees and the parallax in millimetres on the wall.
std::string disparity_text(const scene::Disparity& disparity) {
  return fmt::format("{:+.2f}\u00b0 ({:+.0f} mm)", -glm::degrees(disparity.crossed_rad), disparity.uncrossed_m * 1e3);
}

}  // namespace

DepthReport report_depth(const render::DepthRange& range, double distance_m, double ipd_m, Relief relief) {
  DepthReport report{.measured = true,
                     .range = range,
                     .nearest = scene::disparity_at(distance_m, ipd_m, range.nearest_m),
                     .farthest = scene::disparity_at(distance_m, ipd_m, range.farthest_m),
                     .relief = relief};
  const double most = std::max(std::abs(report.nearest.crossed_rad), std::abs(report.farthest.crossed_rad));
  report.hard = most > scene::kComfortableDisparityRad;
  return report;
}

std::string depth_text(const DepthReport& report, const Phrases& phrases) {
  using enum Phrase;
  if (!report.measured) return {};
  std::string text =
      phrases.text<Depth>(fmt::format("{:.2f}", report.range.nearest_m), fmt::format("{:.2f}", report.range.farthest_m),
                          disparity_text(report.nearest), disparity_text(report.farthest));
  if (report.hard) {
    text += ", " + phrases[report.relief == Relief::BringToWall ? DepthBringToWall : DepthNarrowEyes];
  }
  // eyes closer together than the far parallax would have to diverge
  if (report.farthest.uncrossed_m > scene::kSmallestIpdM) {
    text += "; " + phrases.text<DepthWideEyes>(fmt::format("{:.0f}", std::ceil(report.farthest.uncrossed_m * 1e3)));
  }
  return text;
}

render::Label depth_label(const DepthReport& report, const scene::Screen& screen, const Phrases& phrases) {
  render::Label label{
      .text = depth_text(report, phrases), .highlighted = report.hard, .placement = render::kNoPlacement};
  if (label.text.empty()) return label;
  const glm::dvec3 right = screen.lower_right - screen.lower_left, up = screen.upper_left - screen.lower_left;
  label.placement = {
      .lower_left_m = screen.lower_left + 0.01 * right + 0.01 * up, .right_m = 0.46 * right, .up_m = 0.03 * up};
  return label;
}

}  // namespace afm::exhibit
