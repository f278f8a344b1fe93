// SPDX-License-Identifier: Apache-2.0
#include "app/mouse_wand.h"

#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>

namespace afm::app {

input::Ray MouseWand::ray(const WallPicture& picture, const glm::dvec2& cursor_px) const {
  const glm::dvec2 size(picture.place.size_px);
  glm::dvec2 share = (cursor_px - glm::dvec2(picture.place.offset_px)) / size;
  std::size_t shown = picture.layout == render::Layout::Right ? 1 : 0;
  if (picture.layout == render::Layout::SideBySide) {
    shown = share.x >= 0.5 ? 1 : 0;
    share.x = 2.0 * share.x - static_cast<double>(shown);
  }
  const glm::dvec3 eye = picture.eyes[shown].eye_position_m;
  const glm::dvec3 point = screen_.upper_left + share.x * (screen_.lower_right - screen_.lower_left) +
                           share.y * (screen_.lower_left - screen_.upper_left);
  return {.origin_m = eye, .direction = glm::normalize(point - eye)};
}

input::WandState MouseWand::towards(const glm::dvec3& target_m, std::int64_t now_ns) const {
  const glm::dvec3 direction = glm::normalize(target_m - grip_m_);
  return {.time_ns = now_ns,
          .position_m = grip_m_,
          .room_from_wand = glm::rotation(glm::dvec3(0.0, 0.0, -1.0), direction),
          .orientation_valid = true,
          .connected = true};
}

glm::dvec3 MouseWand::wall_point(const input::Ray& ray) const {
  const glm::dvec3 normal = screen_.normal();
  const double distance = glm::dot(screen_.lower_left - ray.origin_m, normal) / glm::dot(ray.direction, normal);
  return ray.origin_m + distance * ray.direction;
}

}  // namespace afm::app
