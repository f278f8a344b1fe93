// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/display/wall.h"

namespace afm::exhibit {

// Fills the screen with the picture for setting it up, instead of the scene.
void show_calibration(const scene::Screen& screen, scene::StereoMode mode, double ipd_m, const Phrases& phrases,
                      render::FrameState& frame);

}  // namespace afm::exhibit
