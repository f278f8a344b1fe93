// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "drawing/scene_geometry.h"

namespace afm::render {

// Box in a node's frame, along its axes.
struct DrawBox {
  glm::dvec3 center;
  glm::dvec3 half_size;
};

// Bounding box of a straight draw.
DrawBox box_of(const Draw& draw);

// Bounding box of a bent draw, or of a bent part of it given by its own box. The bend is that of its DrawBlock.
DrawBox bent_box(const DrawBox& box, const glm::vec4& bend);
DrawBox bent_box(const Draw& draw, const glm::vec4& bend);

// Smallest and largest value of dot(form, (place, 1)) over the box.
std::pair<double, double> range(const glm::dvec4& form, const DrawBox& box);

}  // namespace afm::render
