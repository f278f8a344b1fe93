// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"
#include "render/frame.h"

namespace afm::render {

// The image as the bytes of a PNG file: 8-bit sRGB without alpha.
core::Result<std::vector<std::uint8_t>> encode_png(const Image& image);

// Writes a temporary file beside `path` and renames it, so that a file of that name is always whole. The error names
// the path.
core::Result<void> write_png(const Image& image, const std::string& path);

}  // namespace afm::render
