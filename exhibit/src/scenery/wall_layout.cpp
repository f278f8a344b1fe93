// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/wall_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace afm::exhibit {

using glm::dmat4;
using glm::dvec3;

namespace {

// Height of laser and photodiode of which the banner may hide little.
constexpr double kTop = 0.3 * kPhotodiodeHalfSize;
constexpr std::array kTops{dvec3(kLaser.x, kLaser.y + kTop, kLaser.z),
                           dvec3(kPhotodiode.x, kPhotodiode.y + kTop, kPhotodiode.z)};

// Largest scale for each arrangement, whatever the viewer sees from above.
WallShape largest_shape(const StagePlace& stage, std::size_t swatches) {
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

// True if the banner covers laser or photodiode, which lean towards the viewer before a floor.
bool banner_hides_top(const StagePlace& stage, const WallShape& shape) {
  const Contact contact = contact_of(stage, shape);
  if (contact.turn_rad == 0.0) return false;
  const double unit = shape.unit_m;
  const double highest = (stage.main.height_m() - contact.height_m) / unit - kBannerHeight - kPanelMargin;
  const dvec3 eye = contact.to_eye_m / unit;
  const dmat4 turn = glm::rotate(dmat4(1.0), contact.turn_rad, dvec3(1.0, 0.0, 0.0));
  return std::any_of(kTops.begin(), kTops.end(), [&](const dvec3& top) {
    const dvec3 place(turn * glm::dvec4(top, 1.0));
    return place.z >= eye.z || eye.y + (place.y - eye.y) * eye.z / (eye.z - place.z) > highest;
  });
}

}  // namespace

Contact contact_of(const StagePlace& stage, const WallShape& shape) {
  // in the middle, no higher than the eyes, and at their height above a deep shelf; moved to leave room above and
  // below, but within the wall's middle third
  const scene::Screen& screen = stage.main;
  const dvec3 right = glm::normalize(screen.lower_right - screen.lower_left), out = screen.normal();
  const dvec3 up = glm::cross(out, right);
  const bool narrow = shape.arrangement == Arrangement::Below, deep = shape.room_below > kRoomBelow;
  const double eye_height = glm::dot(stage.viewer_m - screen.lower_left, up), third = screen.height_m() / 3.0;
  const double lowest = std::max((narrow ? kRoomBelowPanels : shape.room_below) * shape.unit_m, third);
  const double highest =
      std::min(screen.height_m() - (narrow ? kRoomAboveNarrow : kRoomAbove) * shape.unit_m, 2.0 * third);
  const double most = std::max(lowest, highest), middle = 0.5 * (lowest + most);
  Contact contact{.height_m = std::clamp(deep ? eye_height : std::min(eye_height, middle), lowest, most)};
  contact.place_m = screen.lower_left + 0.5 * screen.width_m() * right + contact.height_m * up;
  contact.to_eye_m = glm::transpose(glm::dmat3(right, up, out)) * (stage.viewer_m - contact.place_m);
  const double look = std::atan2(contact.to_eye_m.y, contact.to_eye_m.z);
  if (look < -kLowestLookRad) contact.turn_rad = -look;
  return contact;
}

WallShape wall_shape(const StagePlace& stage, std::size_t swatches) {
  constexpr double kSmaller = 0.98, kLeast = 0.5;
  WallShape shape = largest_shape(stage, swatches);
  const double least_m = kLeast * shape.unit_m;
  while (shape.unit_m > least_m && banner_hides_top(stage, shape)) shape.unit_m *= kSmaller;
  return shape;
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
