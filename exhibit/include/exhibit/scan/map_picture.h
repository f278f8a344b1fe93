// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "curves/curve_map.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// The heights of a force map above its lowest one in false colours, between the 1st and the 99th percentile, with
// `felt` marked. A pixel without a curve has the colour of a place without a measurement.
render::MapPicture map_picture(const curves::CurveMap& map, const curves::MapPlace& felt, const Phrases& phrases);

// Position of a pixel in the picture, as ControlTarget::index, and back.
std::size_t target_index(const curves::MapPlace& place, const curves::CurveMap& map);
curves::MapPlace place_of(const render::ControlTarget& target, const curves::CurveMap& map);

}  // namespace afm::exhibit
