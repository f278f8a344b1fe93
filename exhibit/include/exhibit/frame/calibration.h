// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/display/wall.h"

namespace afm::exhibit {

// Shows the picture for setting up a screen on all of it, and nothing else.
void show_calibration(const scene::Screen& screen, scene::StereoMode mode, double ipd_m, const Phrases& phrases,
                      render::FrameState& frame);

}  // namespace afm::exhibit
