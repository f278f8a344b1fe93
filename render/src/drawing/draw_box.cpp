// SPDX-License-Identifier: Apache-2.0
#include "drawing/draw_box.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "drawing/frame_blocks.h"

namespace afm::render {

DrawBox box_of(const Draw& draw) { return {glm::dvec3(draw.center), glm::dvec3(draw.half_size)}; }

DrawBox bent_box(const DrawBox& box, const glm::vec4& bend) {
  DrawBox bent = box;
  // the deflection grows along x (shaders/beam.glsl); beyond its end a loaded beam is straight
  const double reach = (box.center.x + box.half_size.x) * static_cast<double>(bend.x);
  const double xi = std::clamp(reach, 0.0, 1.0);
  bent.half_size.z +=
      std::abs(static_cast<double>(bend.y)) * (0.5 * xi * xi * (3.0 - xi) + 1.5 * std::max(reach - 1.0, 0.0));
  return bent;
}

DrawBox bent_box(const Draw& draw, const glm::vec4& bend) { return bent_box(box_of(draw), bend); }

DrawBox box_of(const Draw& draw, const MeshCopy& copy) {
  return {glm::dvec3(copy.place),
          glm::dvec3(std::abs(static_cast<double>(copy.scale)) * static_cast<double>(draw.reach))};
}

std::span<const MeshCopy> copies_of(const FrameState& frame, scene::NodeIndex node) {
  for (const MeshCopies& each : frame.copies) {
    if (each.node == node) return each.copies;
  }
  return {};
}

std::span<const scene::Vertex> shape_of(const FrameState& frame, scene::NodeIndex node) {
  for (const MeshShape& each : frame.shapes) {
    if (each.node == node) return each.vertices;
  }
  return {};
}

DrawBox shown_box(const FrameState& frame, const Draw& draw) {
  if (draw.most_copies == 0) return bent_box(draw, bend_of(frame, draw.node));
  return box_around(draw, copies_of(frame, draw.node));
}

DrawBox box_around(const Draw& draw, std::span<const MeshCopy> copies) {
  if (copies.empty()) return {glm::dvec3(0.0), glm::dvec3(0.0)};
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const MeshCopy& copy : copies) {
    const DrawBox box = box_of(draw, copy);
    low = glm::min(low, box.center - box.half_size);
    high = glm::max(high, box.center + box.half_size);
  }
  return {0.5 * (low + high), 0.5 * (high - low)};
}

std::pair<double, double> range(const glm::dvec4& form, const DrawBox& box) {
  const glm::dvec3 slope(form);
  const double middle = glm::dot(slope, box.center) + form.w;
  const double reach = glm::dot(glm::abs(slope), box.half_size);
  return {middle - reach, middle + reach};
}

}  // namespace afm::render
