// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

// An image in an Igor wave. Asylum Research's have three dimensions with one layer per channel, named by the labels
// "HeightTrace", "HeightRetrace"; a matrix is one channel. x is along the first dimension, rows are stored from bottom
// to top. The unit is the wave's, or else determined by the name: metres for heights, deflections and amplitudes,
// degrees for phases, otherwise volts; for a matrix it is unknown. Throws CurveError.
ImagePages read_igor_image(std::string_view bytes);

}  // namespace afm::curves
