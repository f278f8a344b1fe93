// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "render/context.h"

namespace afm::render {

// Device memory in bytes for two eye images with this many samples per pixel: colour and depth of 4 bytes each.
double eye_memory_bytes(glm::uvec2 eye_px, std::uint32_t samples);

// Samples per pixel for images that are drawn once: 4, or 1 if the device memory cannot hold eyes of that size with 4
// samples plus a composed image.
std::uint32_t samples_within_memory(Context& context, glm::uvec2 eye_px);

}  // namespace afm::render
