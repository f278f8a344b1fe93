// SPDX-License-Identifier: Apache-2.0
#include "marker_layout.h"

#include <algorithm>

namespace afm::render {
namespace {

constexpr float kBeside = 6.0F;  // from the line
constexpr float kApart = 4.0F;   // from label to label

// Places from the best to the worst: along the line, and at each on its one side and on its other.
std::vector<glm::vec2> candidates(const MarkerLabel& label, const LabelBox& plot) {
  const bool vertical = label.kind == PlotMarker::Kind::VerticalLine;
  const glm::vec2 size = label.size;
  std::vector<glm::vec2> places;
  if (vertical) {
    for (float y = plot.from.y + kApart; y + size.y <= plot.to.y; y += size.y + kApart) {
      places.emplace_back(label.line + kBeside, y);
      places.emplace_back(label.line - kBeside - size.x, y);
    }
    return places;
  }
  // at the left first, where an approach-retract curve leaves room below zero
  const bool upper_half = label.line < 0.5F * (plot.from.y + plot.to.y);
  const float below = label.line + kApart, above = label.line - kApart - size.y;
  for (float x = plot.from.x + 2.0F * kApart; x + size.x <= plot.to.x; x += 0.25F * size.x) {
    places.emplace_back(x, upper_half ? below : above);
    places.emplace_back(x, upper_half ? above : below);
  }
  return places;
}

}  // namespace

bool overlap(const LabelBox& a, const LabelBox& b) {
  return a.from.x < b.to.x && b.from.x < a.to.x && a.from.y < b.to.y && b.from.y < a.to.y;
}

std::vector<LabelBox> place_labels(std::span<const MarkerLabel> labels, const LabelBox& plot,
                                   std::vector<LabelBox> taken) {
  std::vector<LabelBox> placed;
  for (const MarkerLabel& label : labels) {
    const std::vector<glm::vec2> places = candidates(label, plot);
    const auto free = std::find_if(places.begin(), places.end(), [&](const glm::vec2& from) {
      const LabelBox box{from, from + label.size};
      const bool inside =
          from.x >= plot.from.x && from.y >= plot.from.y && box.to.x <= plot.to.x && box.to.y <= plot.to.y;
      return inside && std::none_of(taken.begin(), taken.end(), [&](const LabelBox& t) { return overlap(box, t); });
    });
    const glm::vec2 from = free != places.end() ? *free : places.empty() ? plot.from : places.front();
    placed.push_back({from, from + label.size});
    taken.push_back(placed.back());
  }
  return placed;
}

}  // namespace afm::render
