// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

namespace afm::exhibit {

namespace {

// Adds ramps, and aligns the grid with those of overlapping screens: lines lie at the same places on the wall.
void add_blending(const scene::Screen& screen, const Phrases& phrases, render::CalibrationPanel& panel) {
  const glm::dvec3 from_middle = screen.blend->origin - screen.center();
  panel.grid_from_m = {glm::dot(from_middle, glm::normalize(screen.lower_right - screen.lower_left)),
                       -glm::dot(from_middle, glm::normalize(screen.upper_left - screen.lower_left))};
  panel.ramps = screen.blend->ramps;
  for (std::size_t edge = 0; edge < panel.ramps.size(); ++edge) {
    const double width_m = panel.ramps.at(edge).width_m;
    if (width_m > 0.0) panel.ramp_widths.at(edge) = phrases.number(fmt::format("{:.0f} mm", width_m * 1e3));
  }
}

}  // namespace

void show_calibration(const scene::Screen& screen, scene::StereoMode mode, double ipd_m, const Phrases& phrases,
                      render::FrameState& frame) {
  frame.visible.assign(frame.room_from_node.size(), 0);
  hide(frame.panels);
  frame.labels.clear();
  constexpr double kSmallScreenM = 1.0;
  const double square_m = screen.width_m() < kSmallScreenM ? 0.01 : 0.1;
  // a single picture for both eyes has no letter of an eye
  const bool eye_marks = mode != scene::StereoMode::Mono;
  frame.panels.calibration.content = {
      .size = phrases.number(fmt::format("{}   {:.3f} m x {:.3f} m", screen.name, screen.width_m(), screen.height_m())),
      .mode = std::string(scene::name_of(mode)),
      .legend = phrases.text<Phrase::PatternSquare>(fmt::format("{:g} mm", square_m * 1e3)) + "; " +
                phrases[eye_marks ? Phrase::PatternEyes : Phrase::PatternOneEye],
      .ruler = phrases.text<Phrase::PatternRuler>(fmt::format("{:.1f} mm", ipd_m * 1e3)),
      .square_m = square_m,
      .ipd_m = ipd_m,
      .eye_marks = eye_marks};
  if (screen.blend) add_blending(screen, phrases, frame.panels.calibration.content);
  frame.panels.calibration.placement = {.lower_left_m = screen.lower_left,
                                        .right_m = screen.lower_right - screen.lower_left,
                                        .up_m = screen.upper_left - screen.lower_left};
}

}  // namespace afm::exhibit
