// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/graph/pbr_material.h"

namespace afm::scene {

// Limits: pixels per side of a PNG or JPEG image, and pixels of all images of a model together.
inline constexpr std::uint32_t kLargestImageSide = 16384;
inline constexpr std::uint64_t kMostImagePixels = 128ULL << 20U;

struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

// Reads the size from the header, without decoding. Throws GltfError if the data are neither PNG nor JPEG, or the image
// is too large.
ImageSize image_size(std::span<const std::uint8_t> encoded);

// Decodes to eight bits RGBA; ignores colour spaces and gamma in the file, as glTF requires. `image` has the size
// returned by image_size(). Throws GltfError. Any thread.
void decode_image(std::span<const std::uint8_t> encoded, Image& image);

}  // namespace afm::scene
