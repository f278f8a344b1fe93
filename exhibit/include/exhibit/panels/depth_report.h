// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/words/phrases.h"
#include "render/depth_meter.h"
#include "render/frame.h"
#include "scene/display/disparity.h"

namespace afm::exhibit {

// The advice for a depth that is hard to look at, apart from stepping back: the key that brings a scene that was moved
// to the wall, or the one that draws for eyes less far apart.
enum class Relief { BringToWall, NarrowEyes };

// The demands of a picture's depth on the viewer's eyes.
struct DepthReport {
  bool measured = false;
  render::DepthRange range{};
  scene::Disparity nearest, farthest;
  bool hard = false;  // beyond the one-degree rule: some see double
  Relief relief = Relief::NarrowEyes;
};

// For eyes `ipd_m` apart, level and facing a wall at `distance_m`.
DepthReport report_depth(const render::DepthRange& range, double distance_m, double ipd_m, Relief relief);

// One line; empty before the first measurement.
std::string depth_text(const DepthReport& report, const Phrases& phrases);

// The line in the screen's lower left corner; nothing while there is no text.
render::Label depth_label(const DepthReport& report, const scene::Screen& screen, const Phrases& phrases);

}  // namespace afm::exhibit
