// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "render/context.h"

namespace afm::render {

// Bytes of device memory for two eye images with as many samples a pixel: colour and depth of 4 bytes each.
double eye_memory_bytes(glm::uvec2 eye_px, std::uint32_t samples);

// Samples a pixel for images that are drawn once: 4, or 1 where the device lacks the memory for eyes of that size
// with 4 and a composed image beside them.
std::uint32_t samples_within_memory(Context& context, glm::uvec2 eye_px);

}  // namespace afm::render
