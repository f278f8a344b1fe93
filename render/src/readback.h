// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "memory.h"
#include "render/frame.h"

namespace afm::render {

// Copies one layer of an 8-bit RGBA image that lies in eShaderReadOnlyOptimal, and leaves it there; waits for the
// queue.
Image read_back(const Device& device, vk::Image image, std::uint32_t layer, vk::Extent2D extent);

}  // namespace afm::render
