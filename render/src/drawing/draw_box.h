// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>

#include "drawing/scene_geometry.h"
#include "render/frame.h"

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

// Bounding box of a copy of a draw's mesh, however it is turned.
DrawBox box_of(const Draw& draw, const MeshCopy& copy);

// Copies of a node's mesh in a frame.
std::span<const MeshCopy> copies_of(const FrameState& frame, scene::NodeIndex node);

// Vertices that a frame gives a node's mesh; empty if none.
std::span<const scene::Vertex> shape_of(const FrameState& frame, scene::NodeIndex node);

// Bounding box of everything that a draw shows in a frame: its bent mesh, or all copies. Without copies, where there is
// room for some, a box of size 0.
DrawBox shown_box(const FrameState& frame, const Draw& draw);

// Bounding box of some copies of a draw's mesh; of size 0 without any.
DrawBox box_around(const Draw& draw, std::span<const MeshCopy> copies);

// Smallest and largest value of dot(form, (place, 1)) over the box.
std::pair<double, double> range(const glm::dvec4& form, const DrawBox& box);

}  // namespace afm::render
