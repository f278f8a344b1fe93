// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "curves/image_file.h"
#include "physics/imaging/scan_image.h"

// Images in Gwyddion's published file formats. Every channel has columns times rows values.
namespace afm::curves {

// The format for a file name's extension: ".gwy" contains every channel with its title in double precision, each with
// the metadata; ".gsf" contains one channel in single precision, with the metadata in its header. Empty for any other
// extension.
std::optional<ImageFormat> image_format(std::string_view path);

std::string gwy_bytes(const physics::ScanImage& image);

// Writes only metadata that a header line can contain: no line breaks, and in keys neither "=" nor the format's own
// names.
std::string gsf_bytes(const physics::ScanImage& image, std::size_t channel);

}  // namespace afm::curves
