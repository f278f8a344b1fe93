// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

inline constexpr std::string_view kGsfMagic = "Gwyddion Simple Field 1.0\n";

// Gwyddion's simple field (Gwyddion user guide, "Gwyddion Simple Field"): lines of text, 1 to 4 NULs up to a multiple
// of 4, floats of 32 bits from the top row on. A missing XReal or YReal means 1; NaN is a masked point. Throws
// CurveError.
ImagePages read_gsf(std::string_view bytes);

}  // namespace afm::curves
