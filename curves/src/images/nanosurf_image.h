// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

// Images of Nanosurf (.nid, .ezd; bytes/nanosurf_header.h). Rows run from bottom to top. In a stopped scan, lines
// whose values are all equal count as not measured. Spectroscopy is left out by name. Throws CurveError.
ImagePages read_nanosurf_image(std::string_view bytes);

}  // namespace afm::curves
