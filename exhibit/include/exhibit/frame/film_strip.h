// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "render/frame.h"

namespace afm::exhibit {

// Frames of equal size, each reduced by an integer factor (every pixel is the mean of factor x factor of the frame's,
// in the encoded values), in rows of `columns` from the top left.
render::Image film_strip(std::span<const render::Image> frames, std::uint32_t columns, std::uint32_t factor);

}  // namespace afm::exhibit
