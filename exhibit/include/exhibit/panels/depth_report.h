// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/words/phrases.h"
#include "render/depth_meter.h"
#include "render/frame.h"
#include "scene/display/disparity.h"

namespace afm::exhibit {

// Advice for a depth that strains the eyes, in addition to stepping back: press the key that brings a moved scene back
// to the wall, or the one that narrows the eye distance.
enum class Relief { BringToWall, NarrowEyes };

// The demands of a picture's depth on the viewer's eyes.
struct DepthReport {
  bool measured = false;
  render::DepthRange range{};
  scene::Disparity nearest, farthest;
  bool hard = false;  // true: one-degree rule exceeded, so some viewers see double
  Relief relief = Relief::NarrowEyes;
};

// Report for eyes `ipd_m` apart, level and facing a wall at `distance_m`.
DepthReport report_depth(const render::DepthRange& range, double distance_m, double ipd_m, Relief relief);

// One line; empty before the first measurement.
std::string depth_text(const DepthReport& report, const Phrases& phrases);

// Label with that line in the screen's lower left corner; empty if there is no text.
render::Label depth_label(const DepthReport& report, const scene::Screen& screen, const Phrases& phrases);

}  // namespace afm::exhibit
