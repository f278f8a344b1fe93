// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "physics/scan_image.h"

// Images as files of Gwyddion, from its published layouts. Every channel has columns times rows values.
namespace afm::curves {

enum class ImageFormat {
  Gwy,  // every channel with its title, double precision, the metadata with each
  Gsf,  // Gwyddion Simple Field: one channel, single precision, the metadata in its header
};

// By the ending of a file's name, ".gwy" or ".gsf".
std::optional<ImageFormat> image_format(std::string_view path);

std::string gwy_bytes(const physics::ScanImage& image);

// Of a metadata key only what a header line can hold is written: no line breaks, and "=" and what the format itself
// names not in keys.
std::string gsf_bytes(const physics::ScanImage& image, std::size_t channel);

}  // namespace afm::curves
