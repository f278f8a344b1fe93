// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "physics/imaging/scan_image.h"
#include "render/frame.h"

namespace afm::exhibit {

// Draws a channel in false colours over its whole range, at least 256 pixels wide, row 0 on top; places without a value
// are grey. Adds a labelled colour bar on the right and a scale bar of a round length below.
render::Image picture_of(const physics::ScanImage& image, std::size_t channel);

}  // namespace afm::exhibit
