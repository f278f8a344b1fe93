// SPDX-License-Identifier: Apache-2.0
#include "app/display/mouse_wand.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>

namespace afm::app {

input::Ray MouseWand::ray(const WallPicture& picture, const glm::dvec2& cursor_px) const {
  const glm::dvec2 in_picture = cursor_px - glm::dvec2(picture.place.offset_px);
  const glm::dvec2 last(picture.place.size_px - 1U);
  const glm::dvec2 pixel = glm::clamp(glm::floor(in_picture), glm::dvec2(0.0), last);
  const scene::StereoMode mode = picture.composition.mode;
  const auto source = scene::source_of_pixel(mode, picture.composition.order, picture.place.size_px, glm::uvec2(pixel));
  glm::dvec2 uv = source.uv + (in_picture - pixel - 0.5) * source.uv_per_pixel;

  // from the middle of the eyes if both or neither see the cursor
  glm::dvec3 eye = 0.5 * (picture.eyes[0].eye_position_m + picture.eyes[1].eye_position_m);
  if (source.eye == scene::PixelEye::Blank) {
    uv = in_picture / glm::dvec2(picture.place.size_px);
  } else if (source.eye != scene::PixelEye::Both && !scene::is_interleaved(mode)) {
    eye = picture.eyes[source.eye == scene::PixelEye::Left ? 0 : 1].eye_position_m;
  }
  // a projector's correction is applied after the layout
  const auto warped = picture.composition.warp ? scene::warped_place(*picture.composition.warp, uv) : std::nullopt;
  if (warped) uv = warped->picture;
  const glm::dvec3 keystone = picture.composition.picture_from_output * glm::dvec3(uv, 1.0);
  if (keystone.z > 0.0) uv = glm::dvec2(keystone) / keystone.z;
  const scene::Screen& screen = picture.screen;
  const glm::dvec3 point = screen.upper_left + uv.x * (screen.lower_right - screen.lower_left) +
                           uv.y * (screen.lower_left - screen.upper_left);
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
  const glm::dvec3 normal = stage_.normal();
  const double distance = glm::dot(stage_.lower_left - ray.origin_m, normal) / glm::dot(ray.direction, normal);
  return ray.origin_m + distance * ray.direction;
}

}  // namespace afm::app
