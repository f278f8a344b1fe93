// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// The servo's state for the wall: scale of the hand, the device and its force limits, timing, and the motors' heat once
// it matters.
std::vector<render::DataRow> servo_rows(const scene::TipState& tip, const scene::ServoTiming& timing,
                                        const scene::SharedDevice& device, const Phrases& phrases);

}  // namespace afm::exhibit
