// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/wall_layout.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace afm::exhibit {

using glm::dmat4;
using glm::dvec3;

WallShape wall_shape(const StagePlace& stage, std::size_t swatches) {
  const double width_m = stage.main.width_m(), height_m = stage.main.height_m();
  if (stage.left && stage.right) {
    return {.arrangement = Arrangement::SideScreens,
            .unit_m = std::min(width_m / kNarrowWidth, height_m / (kDeepRoomBelow + kRoomAbove)),
            .room_below = kDeepRoomBelow};
  }
  const double room_below = swatches <= kFrontSwatches ? kRoomBelow : kDeepRoomBelow;
  const WallShape beside{.arrangement = Arrangement::Beside,
                         .unit_m = std::min(width_m / kReferenceWallWidthM, height_m / (room_below + kRoomAbove)),
                         .room_below = room_below};
  const double narrow_height = kRoomBelowPanels + kRoomAboveNarrow;
  const WallShape below{.arrangement = Arrangement::Below,
                        .unit_m = std::min(width_m / kNarrowWidth, height_m / narrow_height),
                        .room_below = kDeepRoomBelow};
  return beside.unit_m >= below.unit_m ? beside : below;
}

dmat4 frame_matrix(const dvec3& x, const dvec3& y, const dvec3& z, const dvec3& origin) {
  return {glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0), glm::dvec4(origin, 1.0)};
}

dmat4 looking_along(const dvec3& origin, const dvec3& direction) {
  const dvec3 z = glm::normalize(direction);
  const dvec3 reference = std::abs(z.y) < 0.99 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  const dvec3 x = glm::normalize(glm::cross(reference, z));
  return frame_matrix(x, glm::cross(z, x), z, origin);
}

dmat4 stretched(const dvec3& from, const dvec3& to, double radius) {
  const double length = std::max(1e-6, glm::distance(from, to));
  return glm::scale(looking_along(from, to - from), dvec3(radius, radius, length));
}

}  // namespace afm::exhibit
