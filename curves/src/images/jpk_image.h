// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

// Images of JPK (.jpk): a TIFF whose first page is a thumbnail with the grid's tags 0x8040 to 0x8045, and whose other
// pages are channels of 16-bit or 32-bit integers with their name (0x8052 or 0x8050), 0x8051 for the retrace, and
// several calibrations ("slots"), of which the default one (0x8081) applies. Rows are stored from bottom to top unless
// the grid is reflected.
ImagePages read_jpk_image(std::string_view bytes);

}  // namespace afm::curves
