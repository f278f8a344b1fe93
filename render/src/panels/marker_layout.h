// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/frame.h"

// Positions of the labels of a plot's markers, without any drawing. Millimetres, y down.
namespace afm::render {

struct LabelBox {
  glm::vec2 from{0.0F};
  glm::vec2 to{0.0F};

  bool empty() const { return from == to; }
};

bool overlap(const LabelBox& a, const LabelBox& b);

// The box, to the right of the obstacle if they overlap.
LabelBox moved_right_of(const LabelBox& obstacle, const LabelBox& box);

struct MarkerLabel {
  PlotMarker::Kind kind = PlotMarker::Kind::VerticalLine;
  float line = 0;  // x of a vertical line, y of a horizontal one
  glm::vec2 size{0.0F};
};

// Adds one box for each label, in order, inside `plot`. Each box lies next to its line without covering anything in
// `taken`, earlier labels included. A label without such a position has an empty box and is not drawn: with
// large letters, the line alone says more than two overlapping labels.
void place_labels(std::span<const MarkerLabel> labels, const LabelBox& plot, std::vector<LabelBox>& taken);

}  // namespace afm::render
