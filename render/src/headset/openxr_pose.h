// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "headset/openxr.h"
#include "scene/display/wall.h"

namespace afm::render {

inline constexpr XrPosef kOpenXrOrigin{.orientation = {0, 0, 0, 1}, .position = {0, 0, 0}};

inline bool is_placed(XrFlags64 flags) {
  // XrViewStateFlags has the same bits
  constexpr XrFlags64 kBoth = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
  return (flags & kBoth) == kBoth;
}

inline scene::HeadPose to_pose(const XrPosef& pose) {
  const auto& [x, y, z] = pose.position;
  const auto& q = pose.orientation;
  return {.position_m = glm::dvec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)),
          .room_from_head = glm::dquat(static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
                                       static_cast<double>(q.z))};
}

// False for a pose that no runtime should send.
inline bool is_pose(const scene::HeadPose& pose) {
  const glm::dvec3& p = pose.position_m;
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) &&
         std::abs(glm::length(pose.room_from_head) - 1.0) < 1e-3;
}

// Transforms a pose from a frame to the room; `room_from_frame` is the pose of that frame in the room.
inline scene::HeadPose in_room(const scene::HeadPose& room_from_frame, const scene::HeadPose& pose) {
  return {.position_m = room_from_frame.position_m + room_from_frame.room_from_head * pose.position_m,
          .room_from_head = room_from_frame.room_from_head * pose.room_from_head};
}

// Inverse of in_room(): transforms a pose from the room to that frame.
inline XrPosef from_room(const scene::HeadPose& room_from_frame, const scene::HeadPose& pose) {
  const glm::dquat frame_from_room = glm::conjugate(room_from_frame.room_from_head);
  const glm::vec3 place(frame_from_room * (pose.position_m - room_from_frame.position_m));
  const glm::quat turn(glm::normalize(frame_from_room * pose.room_from_head));
  return {.orientation = {turn.x, turn.y, turn.z, turn.w}, .position = {place.x, place.y, place.z}};
}

}  // namespace afm::render
