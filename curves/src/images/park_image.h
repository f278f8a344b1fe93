// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

// An image of Park Systems (.tiff): a preview, and in private tags the numbers (0xC502: 16-bit or 32-bit integers or
// floats, rows from bottom to top) and a header (0xC503), whose layout is that of XEI's "image header": value = gain x
// (scale x number + offset), sides in micrometres. One channel a file. Throws CurveError, also for a line profile and
// for spectroscopy.
ImagePages read_park_image(std::string_view bytes);

// Returns whether these are the bytes of a TIFF of Park Systems, as far as they reach its first page.
bool looks_like_park(std::string_view bytes);

}  // namespace afm::curves
