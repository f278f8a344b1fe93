// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/frame.h"

namespace afm::exhibit {

// Removes everything but the background from the frame: scene, panels and labels.
void blank(render::FrameState& frame);

}  // namespace afm::exhibit
