// SPDX-License-Identifier: Apache-2.0
#include "drawing/panel_sight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "drawing/draw_box.h"

namespace afm::render {
namespace {

constexpr double kBehindM = 1e-3;  // thickness of a panel's plate, within the precision of its place
constexpr double kRightAngle = 1e-6;
constexpr double kMostHidden = 0.1;  // about the size of a corner: objects beside a panel, for a viewer off centre

using Polygon = std::vector<glm::dvec2>;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Convex hull, counter-clockwise (Andrew's monotone chain).
Polygon hull_of(Polygon points) {
  const auto before = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
  std::sort(points.begin(), points.end(), before);
  Polygon hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const glm::dvec2& point : points) {
      while (hull.size() >= begin + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();  // first point of the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// Area of a convex polygon within the unit square.
double area_within_square(Polygon polygon) {
  for (const auto& [inwards, from] : {std::pair(glm::dvec2(1, 0), 0.0),
                                      {glm::dvec2(-1, 0), -1.0},
                                      {glm::dvec2(0, 1), 0.0},
                                      {glm::dvec2(0, -1), -1.0}}) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double a_in = glm::dot(inwards, a) - from, b_in = glm::dot(inwards, b) - from;
      if (a_in >= 0.0) kept.push_back(a);
      if ((a_in >= 0.0) != (b_in >= 0.0)) kept.push_back(glm::mix(a, b, a_in / (a_in - b_in)));
    }
    polygon = std::move(kept);
  }
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

// Corners, counter-clockwise as seen from the front.
std::array<glm::dvec3, 4> corners_of(const PanelPlacement& panel) {
  const glm::dvec3 &from = panel.lower_left_m, &right = panel.right_m, &up = panel.up_m;
  return {from, from + right, from + right + up, from + up};
}

glm::dvec3 front_of(const PanelPlacement& panel) { return glm::normalize(glm::cross(panel.right_m, panel.up_m)); }

// Plane equation, positive on the side of the normal.
glm::dvec4 plane(const glm::dvec3& normal, const glm::dvec3& through) { return {normal, -glm::dot(normal, through)}; }

// Bounds of a panel in an eye's picture: lowest and highest corner. Nothing if the panel is beside or behind the eye.
std::optional<std::pair<glm::dvec2, glm::dvec2>> seen_at(const PanelPlacement& panel, const scene::EyeView& eye) {
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& corner : corners_of(panel)) {
    const glm::dvec4 clip = eye.projection * eye.view * glm::dvec4(corner, 1.0);
    if (!(clip.w > 0.0)) return std::nullopt;
    low = glm::min(low, glm::dvec2(clip) / clip.w);
    high = glm::max(high, glm::dvec2(clip) / clip.w);
  }
  return std::pair(low, high);
}

}  // namespace

bool PanelSight::faces(const PanelPlacement& panel) const {
  const double slant = glm::dot(glm::normalize(panel.right_m), glm::normalize(panel.up_m));
  return std::abs(slant) < kRightAngle &&
         std::all_of(
             frame_.eyes.begin(), frame_.eyes.end(),
             [&](const scene::EyeView& eye) {
               return glm::dot(front_of(panel), eye.eye_position_m - panel.lower_left_m) > 0.0;
             });
}

bool PanelSight::may_be_hidden(const PanelPlacement& panel) const {
  if (frame_.fog.end_m > frame_.fog.begin_m) return false;  // panels drawn before everything else
  return std::any_of(frame_.eyes.begin(), frame_.eyes.end(), [&](const scene::EyeView& eye) {
    double share = 0.0;
    for (const auto* drawn : {&draws_.opaque, &draws_.blended}) {
      for (const std::uint32_t draw : *drawn) share += hidden_share(geometry_.draws()[draw], eye, panel);
    }
    return share > kMostHidden;
  });
}

// Share of the panel that the outline of the draw's box covers, an upper limit.
double PanelSight::hidden_share(const Draw& draw, const scene::EyeView& eye, const PanelPlacement& panel) const {
  if (!reaches_between(draw, eye, panel)) return 0.0;
  const DrawBox box = shown_box(frame_, draw);
  const glm::dvec3 front = front_of(panel);
  const glm::dvec3 across = panel.right_m / glm::dot(panel.right_m, panel.right_m);
  const glm::dvec3 upwards = panel.up_m / glm::dot(panel.up_m, panel.up_m);
  Polygon outline;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::dvec3 side((corner & 1U) != 0 ? 1.0 : -1.0, (corner & 2U) != 0 ? 1.0 : -1.0,
                          (corner & 4U) != 0 ? 1.0 : -1.0);
    const glm::dvec3 place(frame_.room_from_node[draw.node] * glm::dvec4(box.center + side * box.half_size, 1.0));
    const glm::dvec3 towards = place - eye.eye_position_m;
    const double speed = glm::dot(front, towards);
    if (!(speed < 0.0)) return 1.0;  // direction beside or behind the eye
    const glm::dvec3 hit =
        eye.eye_position_m + towards * (glm::dot(front, panel.lower_left_m - eye.eye_position_m) / speed);
    outline.emplace_back(glm::dot(across, hit - panel.lower_left_m), glm::dot(upwards, hit - panel.lower_left_m));
  }
  return area_within_square(hull_of(std::move(outline)));
}

// True if the draw's box reaches into the pyramid from the eye to the panel: no face of either separates them.
bool PanelSight::reaches_between(const Draw& draw, const scene::EyeView& eye, const PanelPlacement& panel) const {
  const glm::dmat4& room_from_node = frame_.room_from_node[draw.node];
  const glm::dmat4 rows = glm::transpose(room_from_node);
  const DrawBox box = shown_box(frame_, draw);
  const std::array corners = corners_of(panel);
  const auto beyond = [&](const glm::dvec4& face) { return range(rows * face, box).first > 0.0; };
  if (beyond(plane(-front_of(panel), panel.lower_left_m + kBehindM * front_of(panel)))) return false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 outwards =
        glm::cross(corners[i] - eye.eye_position_m, corners[(i + 1) % corners.size()] - eye.eye_position_m);
    if (beyond(plane(outwards, eye.eye_position_m))) return false;
  }
  const glm::dmat4 node_from_room = glm::inverse(room_from_node);
  glm::dvec3 low(node_from_room * glm::dvec4(eye.eye_position_m, 1.0)), high = low;
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 in_node(node_from_room * glm::dvec4(corner, 1.0));
    low = glm::min(low, in_node);
    high = glm::max(high, in_node);
  }
  return glm::all(glm::lessThanEqual(low, box.center + box.half_size)) &&
         glm::all(glm::greaterThanEqual(high, box.center - box.half_size));
}

bool PanelSight::may_overlap(const PanelPlacement& a, const PanelPlacement& b) const {
  return std::any_of(frame_.eyes.begin(), frame_.eyes.end(), [&](const scene::EyeView& eye) {
    const auto first = seen_at(a, eye), second = seen_at(b, eye);
    return !first || !second ||
           (glm::all(glm::lessThan(first->first, second->second)) &&
            glm::all(glm::lessThan(second->first, first->second)));
  });
}

}  // namespace afm::render
