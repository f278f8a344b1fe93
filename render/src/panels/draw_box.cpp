// SPDX-License-Identifier: Apache-2.0
#include "panels/draw_box.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace afm::render {

DrawBox bent_box(const Draw& draw, const glm::vec4& bend) {
  DrawBox box{glm::dvec3(draw.center), glm::dvec3(draw.half_size)};
  // beyond its end a loaded beam is straight, with 3/2 of the mean slope
  const double reach = (box.center.x + box.half_size.x) * static_cast<double>(bend.x);
  box.half_size.z += std::abs(static_cast<double>(bend.y)) * (1.0 + 1.5 * std::max(reach - 1.0, 0.0));
  return box;
}

std::pair<double, double> range(const glm::dvec4& form, const DrawBox& box) {
  const glm::dvec3 slope(form);
  const double middle = glm::dot(slope, box.center) + form.w;
  const double reach = glm::dot(glm::abs(slope), box.half_size);
  return {middle - reach, middle + reach};
}

}  // namespace afm::render
