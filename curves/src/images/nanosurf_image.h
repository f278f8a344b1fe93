// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

// Beginning of Nanosurf's files.
inline constexpr std::string_view kNanosurfMagic = "[DataSet]";

// Images of Nanosurf (.nid, .ezd): sections of "key=value" in Latin-1, then "#!" and the numbers of every channel in
// the order of the groups: integers of 8, 16 or 32 bits. Their lowest value is Dim2Min, their full range Dim2Range.
// Rows run from bottom to top. In a stopped scan, lines whose values are all equal count as not measured. Spectroscopy
// is left out by name. Throws CurveError.
ImagePages read_nanosurf_image(std::string_view bytes);

}  // namespace afm::curves
