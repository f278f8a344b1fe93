// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

// An image in an Igor wave. Asylum Research's has three dimensions: a layer a channel, named by the labels
// "HeightTrace", "HeightRetrace"; a matrix is one channel. x is along the first dimension, rows lie bottom up. The unit
// is the wave's, or else follows from the name: metres for heights, deflections and amplitudes, degrees for phases,
// volts for the rest; of a matrix nothing says it. Throws CurveError.
ImagePages read_igor_image(std::string_view bytes);

}  // namespace afm::curves
