// SPDX-License-Identifier: Apache-2.0
#include "panels/marker_layout.h"

#include <algorithm>

namespace afm::render {
namespace {

constexpr float kBeside = 6.0F;  // distance from the line
constexpr float kApart = 4.0F;   // distance between labels

// Offers `take` positions from best to worst, along the line and at each point on both sides of it, until it accepts
// one.
template <class Take>
void offer_places(const MarkerLabel& label, const LabelBox& plot, Take&& take) {
  const glm::vec2 size = label.size;
  if (label.kind == PlotMarker::Kind::VerticalLine) {
    for (float y = plot.from.y + kApart; y + size.y <= plot.to.y; y += size.y + kApart) {
      if (take(glm::vec2(label.line + kBeside, y)) || take(glm::vec2(label.line - kBeside - size.x, y))) return;
    }
    return;
  }
  // left side first, where an approach-retract curve leaves room below zero
  const bool upper_half = label.line < 0.5F * (plot.from.y + plot.to.y);
  const float below = label.line + kApart, above = label.line - kApart - size.y;
  for (float x = plot.from.x + 2.0F * kApart; x + size.x <= plot.to.x; x += 0.25F * size.x) {
    if (take(glm::vec2(x, upper_half ? below : above)) || take(glm::vec2(x, upper_half ? above : below))) return;
  }
}

}  // namespace

bool overlap(const LabelBox& a, const LabelBox& b) {
  return a.from.x < b.to.x && b.from.x < a.to.x && a.from.y < b.to.y && b.from.y < a.to.y;
}

LabelBox moved_right_of(const LabelBox& obstacle, const LabelBox& box) {
  if (!overlap(obstacle, box)) return box;
  const float by = obstacle.to.x + kApart - box.from.x;
  return {{box.from.x + by, box.from.y}, {box.to.x + by, box.to.y}};
}

void place_labels(std::span<const MarkerLabel> labels, const LabelBox& plot, std::vector<LabelBox>& taken) {
  for (const MarkerLabel& label : labels) {
    LabelBox free;
    offer_places(label, plot, [&](const glm::vec2& from) {
      const LabelBox box{from, from + label.size};
      const bool inside =
          from.x >= plot.from.x && from.y >= plot.from.y && box.to.x <= plot.to.x && box.to.y <= plot.to.y;
      if (!inside || std::any_of(taken.begin(), taken.end(), [&](const LabelBox& t) { return overlap(box, t); })) {
        return false;
      }
      free = box;
      return true;
    });
    taken.push_back(free);
  }
}

}  // namespace afm::render
