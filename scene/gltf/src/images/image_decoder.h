// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/graph/pbr_material.h"

namespace afm::scene {

// Pixels on a side of a PNG or JPEG image that is still decoded; and of all images of a model together.
inline constexpr std::uint32_t kLargestImageSide = 16384;
inline constexpr std::uint64_t kMostImagePixels = 128ULL << 20U;

struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

// Size from the header, without decoding. Throws GltfError if the data is neither PNG nor JPEG, or the image is too
// large.
ImageSize image_size(std::span<const std::uint8_t> encoded);

// Decodes into eight bits RGBA; colour spaces and gamma that the file names are ignored, as glTF demands. `image` has
// the size that image_size() has given. Throws GltfError. Any thread.
void decode_image(std::span<const std::uint8_t> encoded, Image& image);

}  // namespace afm::scene
