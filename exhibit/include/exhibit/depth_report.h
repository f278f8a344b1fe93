// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "render/depth_meter.h"
#include "render/frame.h"
#include "scene/display/disparity.h"

namespace afm::exhibit {

// What a picture's depth asks of the viewer's eyes.
struct DepthReport {
  scene::Disparity nearest, farthest;
  bool hard = false;  // beyond the one-degree rule: for some the picture falls apart
  std::string text;   // one line; empty before the first measurement
};

// What makes a depth easier to look at, beside stepping back: the key that brings a scene that was moved to the wall,
// or the one that draws for eyes less far apart.
enum class Relief { BringToWall, NarrowEyes };

// For eyes `ipd_m` apart, level and facing a wall at `distance_m`.
DepthReport report_depth(const render::DepthRange& range, double distance_m, double ipd_m, Relief relief);

// The line in the screen's lower left corner; nothing while there is no text.
render::Label depth_label(const DepthReport& report, const scene::Screen& screen);

}  // namespace afm::exhibit
