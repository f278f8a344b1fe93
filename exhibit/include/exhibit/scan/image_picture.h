// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "physics/imaging/scan_image.h"
#include "render/frame.h"

namespace afm::exhibit {

// A channel in the false colours of heights over its whole range, at least 256 pixels wide, row 0 on top; places
// without a value are grey. On its right the range as a bar, its ends labelled; below it a bar of a round length.
render::Image picture_of(const physics::ScanImage& image, std::size_t channel);

}  // namespace afm::exhibit
