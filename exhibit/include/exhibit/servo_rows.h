// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "render/frame.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// "fit: each sample on its own scale"
std::string scale_text(scene::ScaleMode mode);

// What the wall says of the servo: what it holds and how hard that may push, on which scale, how punctually, and how
// warm the motors are once that matters.
std::vector<render::DataRow> servo_rows(const scene::TipState& tip, const scene::ServoTiming& timing,
                                        const scene::SharedDevice& device);

}  // namespace afm::exhibit
