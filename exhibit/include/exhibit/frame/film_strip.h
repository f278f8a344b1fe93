// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "render/frame.h"

namespace afm::exhibit {

// Joins frames of equal size in rows of `columns`, from the top left. Reduces each frame by an integer factor: a pixel
// is the mean of factor x factor of the frame's pixels, in encoded values.
render::Image film_strip(std::span<const render::Image> frames, std::uint32_t columns, std::uint32_t factor);

}  // namespace afm::exhibit
