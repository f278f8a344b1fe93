// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "render/frame.h"

namespace afm::render {

enum class ChannelOrder { Rgba, Bgra };

// View of an image in memory it does not own: rows as in Image, four bytes per pixel.
struct ImageSpan {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const std::uint8_t> bytes;
  ChannelOrder order = ChannelOrder::Rgba;

  ImageSpan(std::uint32_t width_px, std::uint32_t height_px, std::span<const std::uint8_t> its_bytes,
            ChannelOrder its_order)
      : width(width_px), height(height_px), bytes(its_bytes), order(its_order) {}
  ImageSpan(const Image& image) : ImageSpan(image.width, image.height, image.rgba, ChannelOrder::Rgba) {}
};

// An independent copy.
Image to_image(const ImageSpan& span);

// Description of a picture, as keys and texts: a key has 1 to 79 characters of ASCII.
using PictureTexts = std::span<const std::pair<std::string, std::string>>;

// Encodes the image as a PNG file: 8-bit sRGB without alpha, with the texts and "Software", the program and its
// version.
core::Result<std::vector<std::uint8_t>> encode_png(const ImageSpan& image, PictureTexts texts = {});

// Writes a temporary file next to `path` and renames it, so that a file of that name is always complete. The error
// names the path.
core::Result<void> write_png(const ImageSpan& image, const std::string& path, PictureTexts texts = {});

}  // namespace afm::render
