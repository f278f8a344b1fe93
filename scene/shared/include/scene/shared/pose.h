// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "scene/shared/field_visitor.h"

namespace afm::scene {

// Position and orientation of a body in the room frame, for messages and files: metres, right-handed, +y up.
struct Pose {
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  // unit quaternion, w x y z: room from body

  bool operator==(const Pose&) const = default;
};

template <class Visit, RecordOf<Pose>... Record>
constexpr void for_each_field(Visit&& visit, Record&... pose) {
  visit("position_m", pose.position_m...);
  visit("orientation_wxyz", pose.orientation...);
}
static_assert(all_fields_described<Pose>());

}  // namespace afm::scene
