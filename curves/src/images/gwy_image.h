// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

inline constexpr std::string_view kGwyMagic = "GWYP";
inline constexpr std::string_view kOldGwyMagic = "GWYO";  // magic of Gwyddion 1's layout: recognised, not read

// Gwyddion's native format (Gwyddion user guide, "Gwyddion native format"): a container of objects. Its data fields
// "/N/data" are the channels, with "/N/data/title" and the strings of "/N/meta". Ignores masks, which are marks of a
// user and not measurements, and everything else. Throws CurveError.
ImagePages read_gwy(std::string_view bytes);

}  // namespace afm::curves
