// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "physics/imaging/height_grid.h"

namespace afm::imaging {

// True for the name of the sample below, unless a file in the current folder has that name.
bool is_gratings(const std::string& sample);

// Two calibration gratings side by side, 1.2 um wide and deep, centred on the origin: bars along y, half as wide as
// their pitch, 200 nm on the left and 100 nm on the right. 10 nm high, with a mean height of zero.
physics::HeightGrid gratings();

}  // namespace afm::imaging
