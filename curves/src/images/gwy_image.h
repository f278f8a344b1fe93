// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

inline constexpr std::string_view kGwyMagic = "GWYP";
inline constexpr std::string_view kOldGwyMagic = "GWYO";  // of Gwyddion 1, with another layout: recognised, not read

// Gwyddion's native format (Gwyddion user guide, "Gwyddion native format"): a container of objects, of which the data
// fields "/N/data" are the channels, with "/N/data/title" and the strings of "/N/meta". Masks, which say what a person
// marked and not what was measured, are passed over, as is everything else. Throws CurveError.
ImagePages read_gwy(std::string_view bytes);

}  // namespace afm::curves
