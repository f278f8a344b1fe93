// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

// An image of Asylum Research in an Igor wave of three dimensions: a layer a channel, named by the labels
// "HeightTrace", "HeightRetrace", with x along the first dimension and rows bottom up. The unit is the wave's, or
// else follows from the name: metres for heights, deflections and amplitudes, degrees for phases, volts for the rest.
// Throws CurveError.
ImagePages read_igor_image(std::string_view bytes);

}  // namespace afm::curves
