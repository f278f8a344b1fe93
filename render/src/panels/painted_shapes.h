// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace afm::render {

// Rectangle of a canvas, in texels, y down; empty if it has no width.
struct CanvasBox {
  glm::vec2 low{0.0F}, high{0.0F};
};

// Triangles of one painting of a panel, compared with the next one to find the differences. Keeps its memory.
class PaintedShapes {
 public:
  void clear();

  // Appends the shapes of an ImGui draw list.
  void add(const ImDrawList& list);

  // Area in which the texels of two paintings may differ; nothing if that may be anywhere. Ignores equal shapes before
  // and after a difference in the painting order.
  std::optional<CanvasBox> difference(const PaintedShapes& other) const;

 private:
  struct Group {
    ImVec4 clip{};
    std::size_t end = 0;  // index one past its last corner
  };
  std::span<const ImDrawVert> corners_of(std::size_t group) const;

  std::vector<ImDrawVert> corners_;  // three corners per triangle
  std::vector<Group> groups_;
};

}  // namespace afm::render
