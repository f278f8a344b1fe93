// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "curves/image_file.h"
#include "physics/imaging/scan_image.h"

// Images as files of Gwyddion, from its published layouts. Every channel has columns times rows values.
namespace afm::curves {

// The format to write, by the ending of a file's name: ".gwy" holds every channel with its title in double precision
// and the metadata with each; ".gsf" holds one channel in single precision, with the metadata in its header. None: no
// other.
std::optional<ImageFormat> image_format(std::string_view path);

std::string gwy_bytes(const physics::ScanImage& image);

// Of a metadata key only what a header line can hold is written: no line breaks, and "=" and what the format itself
// names not in keys.
std::string gsf_bytes(const physics::ScanImage& image, std::size_t channel);

}  // namespace afm::curves
