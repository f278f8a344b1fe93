// SPDX-License-Identifier: Apache-2.0
#include "exhibit/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace afm::exhibit {

void show_calibration(const scene::Screen& screen, scene::StereoMode mode, double ipd_m, const Phrases& phrases,
                      render::FrameState& frame) {
  frame.visible.assign(frame.room_from_node.size(), 0);
  frame.force_placement = frame.data_placement = frame.banner_placement = frame.control_placement =
      render::kNoPlacement;
  frame.labels.clear();
  constexpr double kSmallScreenM = 1.0;
  const double square_m = screen.width_m() < kSmallScreenM ? 0.01 : 0.1;
  // one picture for both eyes: no letter is one eye's
  const bool eye_marks = mode != scene::StereoMode::Mono;
  frame.calibration = {
      .size = phrases.number(fmt::format("{}   {:.3f} m x {:.3f} m", screen.name, screen.width_m(), screen.height_m())),
      .mode = std::string(scene::name_of(mode)),
      .legend = phrases.text<Phrase::PatternSquare>(fmt::format("{:g} mm", square_m * 1e3)) + "; " +
                phrases[eye_marks ? Phrase::PatternEyes : Phrase::PatternOneEye],
      .ruler = phrases.text<Phrase::PatternRuler>(fmt::format("{:.1f} mm", ipd_m * 1e3)),
      .square_m = square_m,
      .ipd_m = ipd_m,
      .eye_marks = eye_marks};
  frame.calibration_placement = {.lower_left_m = screen.lower_left,
                                 .right_m = screen.lower_right - screen.lower_left,
                                 .up_m = screen.upper_left - screen.lower_left};
}

}  // namespace afm::exhibit
