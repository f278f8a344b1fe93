// SPDX-License-Identifier: Apache-2.0
#include "exhibit/calibration.h"

#include <algorithm>
#include <string>

namespace afm::exhibit {

void show_calibration(const scene::Screen& screen, scene::StereoMode mode, double ipd_m, render::FrameState& frame) {
  frame.visible.assign(frame.room_from_node.size(), 0);
  frame.force_placement = frame.data_placement = frame.banner_placement = frame.control_placement =
      render::kNoPlacement;
  frame.labels.clear();
  // one picture for both eyes: no letter is one eye's
  frame.calibration = {.screen = screen.name,
                       .mode = std::string(scene::name_of(mode)),
                       .ipd_m = ipd_m,
                       .eye_marks = mode != scene::StereoMode::Mono};
  frame.calibration_placement = {.lower_left_m = screen.lower_left,
                                 .right_m = screen.lower_right - screen.lower_left,
                                 .up_m = screen.upper_left - screen.lower_left};
}

}  // namespace afm::exhibit
