// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "physics/scan_image.h"
#include "render/frame.h"

namespace afm::exhibit {

// The colour of a height, 0 the lowest and 1 the highest, as AFM programs draw it: from black through brown and yellow
// to white (Gwyddion's gradient "Gwyddion.net"). Its luminance rises throughout. sRGB.
std::array<std::uint8_t, 3> height_color(double share) noexcept;

// A channel in these colours over its whole range, at least 256 pixels wide, row 0 on top; places without a value are
// blue. On its right the range as a bar, its ends labelled; below it a bar of a round length.
render::Image picture_of(const physics::ScanImage& image, std::size_t channel);

}  // namespace afm::exhibit
