// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// Removes everything but the background from the frame: scene, panels, and the labels other than `kept`, which says how
// to get the picture back.
void blank(render::FrameState& frame, std::string_view kept = {});

// Keeps the captions that say why there is no picture, and when it is back.
void blank(render::FrameState& frame, const Phrases& phrases);

}  // namespace afm::exhibit
