// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace afm::render {

// A rectangle of a canvas, in its texels, y down; empty where it has no width.
struct CanvasBox {
  glm::vec2 low{0.0F}, high{0.0F};
};

// The triangles of one painting of a panel, to find where the next one differs. Keeps its memory.
class PaintedShapes {
 public:
  void clear();

  // What ImGui draws in one list, after what is already there.
  void add(const ImDrawList& list);

  // Where the texels of two paintings may differ; none: anywhere. What is equal before and behind a difference, in the
  // order of painting, does not count.
  std::optional<CanvasBox> difference(const PaintedShapes& other) const;

 private:
  struct Group {
    ImVec4 clip{};
    std::size_t end = 0;  // of its corners
  };
  std::span<const ImDrawVert> corners_of(std::size_t group) const;

  std::vector<ImDrawVert> corners_;  // three for each triangle
  std::vector<Group> groups_;
  bool too_many_ = false;
};

}  // namespace afm::render
