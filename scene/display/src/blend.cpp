// SPDX-License-Identifier: Apache-2.0
#include "scene/display/blend.h"

#include <algorithm>

namespace afm::scene {

namespace {

// Smooth step from 0 to 1; the step and its mirror image add up to 1.
double risen(double distance, double begin, double width) {
  if (!(width > 0.0)) return 1.0;
  const double t = std::clamp((distance - begin) / width, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

Blend::Place Blend::at(const glm::dvec2& picture) const {
  Place place;
  for (const Field& field : fields) {
    const std::array inwards{picture.x - field.low.x, picture.y - field.low.y, field.high.x - picture.x,
                             field.high.y - picture.y};
    if (std::any_of(inwards.begin(), inwards.end(), [](double distance) { return distance < 0.0; })) continue;
    double weight = 1.0;
    for (std::size_t edge = 0; edge < inwards.size(); ++edge) {
      weight *= risen(inwards.at(edge), field.begin.at(edge), field.width.at(edge));
    }
    if (&field == fields.data()) place.own = weight;
    place.all += weight;
    place.black += field.black;
  }
  return place;
}

}  // namespace afm::scene
