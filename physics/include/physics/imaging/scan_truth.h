// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "physics/imaging/scan_image.h"
#include "physics/imaging/tip_shape.h"

namespace afm::physics {

// Adds to an image whose first channel is the height the information that it contains about sample and tip
// (physics/imaging/morphology.h), as channels of its size:
//
//   "Reconstruction"      the highest sample with this image under `tip`
//   "Certainty"           1 where that is certainly the sample, otherwise 0
//   "Tip from the image"  the bluntest tip that could have taken it, its apex in the middle, at most kBlindReach pixels
//                         to each side; beyond them as low as its lowest place
//
// `noise`: rms of the height's noise. The image must have no gaps. Takes up to seconds if the tip is many pixels wide.
inline constexpr std::size_t kBlindReach = 8;
void add_truth(const TipShape& tip, Length noise, ScanImage& image);

}  // namespace afm::physics
