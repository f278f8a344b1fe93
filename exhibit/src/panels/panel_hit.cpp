// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/panel_hit.h"

#include <glm/geometric.hpp>

namespace afm::exhibit {

glm::dvec2 size_mm(const render::PanelPlacement& panel, double millimetre_m) {
  return glm::dvec2(glm::length(panel.right_m), glm::length(panel.up_m)) / millimetre_m;
}

std::optional<PanelHit> hit_of(const input::Ray& ray, const render::PanelPlacement& panel, double millimetre_m) {
  const glm::dvec3 normal = glm::cross(panel.right_m, panel.up_m);
  const double along = glm::dot(ray.direction, normal);
  if (along == 0.0) return std::nullopt;
  const double distance = glm::dot(panel.lower_left_m - ray.origin_m, normal) / along;
  if (!(distance > 0.0)) return std::nullopt;

  const glm::dvec3 point = ray.origin_m + distance * ray.direction;
  const glm::dvec3 offset = point - panel.lower_left_m;
  const double right = glm::dot(offset, panel.right_m) / glm::dot(panel.right_m, panel.right_m);
  const double up = glm::dot(offset, panel.up_m) / glm::dot(panel.up_m, panel.up_m);
  if (!(right >= 0.0 && right <= 1.0 && up >= 0.0 && up <= 1.0)) return std::nullopt;
  return PanelHit{.point_m = point, .place_mm = size_mm(panel, millimetre_m) * glm::dvec2(right, 1.0 - up)};
}

}  // namespace afm::exhibit
