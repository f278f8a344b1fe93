// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "physics/imaging/scan_image.h"
#include "render/frame.h"

namespace afm::exhibit {

struct PictureStyle {
  double cut_share = 0;       // fraction of the values allowed beyond each end of the colours, below 0.5
  std::vector<bool> hatched;  // pixels with dark stripes, row by row from the top; empty: none
};

// Draws a channel in false colours, at least 256 pixels wide, row 0 on top; places without a value are grey. Adds a
// labelled colour bar on the right and a scale bar of a round length below.
render::Image picture_of(const physics::ScanImage& image, std::size_t channel, const PictureStyle& style = {});

// Texts for the picture's file: the channel with its unit, the size of the image, and its metadata.
std::vector<std::pair<std::string, std::string>> picture_texts(const physics::ScanImage& image, std::size_t channel);

}  // namespace afm::exhibit
