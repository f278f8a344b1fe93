// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <png.h>

#include <optional>
#include <string>

#include "render/frame.h"

namespace afm::support {

// Reads any PNG as 8-bit RGBA; empty if it cannot be read.
inline std::optional<render::Image> read_png(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) return std::nullopt;
  png.format = PNG_FORMAT_RGBA;
  render::Image image{.width = png.width, .height = png.height, .rgba = {}};
  image.rgba.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0) return std::nullopt;
  return image;
}

}  // namespace afm::support
