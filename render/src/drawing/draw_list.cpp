// SPDX-License-Identifier: Apache-2.0
#include "drawing/draw_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "drawing/draw_box.h"

namespace afm::render {
namespace {

constexpr std::uint32_t kManyTriangles = 10'000;  // number per draw; smaller draws cost little
constexpr double kFineEdgePx = 8.0;               // limit for nine triangles in ten
constexpr double kLongestEdgePx = 32.0;           // limit for all triangles: the sides of a slab with a fine surface

constexpr double kMostTurn = 0.65;  // share of the lobe's border: pictures of the samples differ by at most 2 of 255

struct Sight {
  bool seen = false;
  bool clipped = false;
};

Sight sight(const glm::dmat4& clip_from_room, const glm::dmat4& room_from_node, const DrawBox& box, double guard_band) {
  const glm::dmat4 rows = glm::transpose(clip_from_room * room_from_node);
  const glm::dvec4 near = rows[3] - rows[2];  // near plane of a reversed depth: z = w
  Sight sight{.seen = range(near, box).second >= 0.0, .clipped = range(near, box).first < 0.0};
  for (glm::length_t axis = 0; axis < 2; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      sight.seen = sight.seen && range(rows[3] + side * rows[axis], box).second >= 0.0;
      sight.clipped = sight.clipped || range(guard_band * rows[3] + side * rows[axis], box).first < 0.0;
    }
  }
  return sight;
}

struct Scale {
  double most = 0;     // metres per unit of the node, along its largest axis
  double stretch = 1;  // ratio of largest to smallest unit: largest magnification of an angle between normals
};
Scale scale_of(const glm::dmat4& room_from_node) {
  const glm::dmat3 linear(room_from_node);
  const auto [least, most] = std::minmax({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
  return {most, most / least};
}

// True if shading per vertex is as good as per fragment. Edge lengths are taken as if they were perpendicular to the
// line of sight, at the centre of the box.
bool is_fine(const Draw& draw, const scene::EyeView& eye, const glm::dmat4& room_from_node, double pixels_high) {
  if (draw.variant || draw.blended || draw.double_sided || draw.unlit || draw.index_count < 3 * kManyTriangles) {
    return false;
  }
  const glm::dvec4 middle = eye.projection * eye.view * room_from_node * glm::dvec4(glm::dvec3(draw.center), 1.0);
  if (middle.w <= 0.0) {
    return false;
  }
  const double pixels_per_unit =
      0.5 * pixels_high * std::abs(eye.projection[1][1]) * scale_of(room_from_node).most / middle.w;
  return static_cast<double>(draw.usual_edge) * pixels_per_unit < kFineEdgePx &&
         (draw.reshaped || static_cast<double>(draw.longest_edge) * pixels_per_unit < kLongestEdgePx);
}

// True if the light varies slowly enough to be computed per vertex: along an edge, the direction in which the eye sees
// the studio reflected stays within the soft edge of the reflection. That direction turns twice as far as the normal.
bool is_smooth(const Draw& draw, const scene::EyeView& eye, const glm::dmat4& room_from_node) {
  if (draw.variant || draw.double_sided || draw.unlit) return false;
  const glm::dvec3 middle_m(room_from_node * glm::dvec4(glm::dvec3(draw.center), 1.0));
  const Scale scale = scale_of(room_from_node);
  const double turn = 2.0 * scale.stretch * static_cast<double>(draw.largest_turn);
  const auto roughness = static_cast<double>(draw.block.surface.y);
  const double most = kMostTurn * AFM_LOBE_BORDER(roughness) - turn;
  return static_cast<double>(draw.usual_edge) * scale.most < most * glm::distance(eye.eye_position_m, middle_m);
}

Shading shading(const Draw& draw, const scene::EyeView& eye, const glm::dmat4& room_from_node, double pixels_high) {
  if (is_fine(draw, eye, room_from_node, pixels_high)) return Shading::ByVertex;
  if (draw.reshaped) return Shading::ByFragment;  // shape with normals that may turn
  return is_smooth(draw, eye, room_from_node) ? Shading::LightByVertex : Shading::ByFragment;
}

}  // namespace

void DrawListBuilder::list(const FrameState& frame, const SceneGeometry& geometry, float guard_band, double pixels_high,
                           DrawList& list) {
  const auto& draws = geometry.draws();
  const std::array clip_from_room{frame.eyes[0].projection * frame.eyes[0].view,
                                  frame.eyes[1].projection * frame.eyes[1].view};
  const glm::dvec3 viewer = 0.5 * (frame.eyes[0].eye_position_m + frame.eyes[1].eye_position_m);
  list.shadow.clear();
  list.mirrored.assign(draws.size(), 0);
  list.shading.assign(draws.size(), Shading::ByFragment);
  list.copies.assign(draws.size(), 1);
  list.clipped = false;
  list.hazy = frame.fog.fade > 0.0F || frame.fog.end_m > frame.fog.begin_m;
  opaque_.clear();
  blended_.clear();
  for (std::uint32_t i = 0; i < draws.size(); ++i) {
    const Draw& draw = draws[i];
    if (!frame.visible.empty() && frame.visible[draw.node] == 0) {
      continue;
    }
    if (draw.most_copies > 0) {
      list.copies[i] = static_cast<std::uint32_t>(copies_of(frame, draw.node).size());
      if (list.copies[i] == 0) continue;
    }
    if (draw.reshaped && shape_of(frame, draw.node).empty()) continue;
    if (draw.casts_shadow && frame.key_light.map_share > 0.0F) {
      list.shadow.push_back(i);
    }
    const auto& room_from_node = frame.room_from_node[draw.node];
    list.mirrored[i] = glm::determinant(glm::dmat3(room_from_node)) < 0.0 ? 1 : 0;
    const DrawBox box = shown_box(frame, draw);
    bool seen = false;
    for (const glm::dmat4& clip : clip_from_room) {
      const Sight its = sight(clip, room_from_node, box, static_cast<double>(guard_band));
      seen = seen || its.seen;
      list.clipped = list.clipped || (its.seen && its.clipped);
    }
    if (seen) {
      const bool copied = draw.most_copies > 0;
      if (!list.hazy && !copied) list.shading[i] = shading(draw, frame.eyes[0], room_from_node, pixels_high);
      // copies that move among themselves keep their place in the order
      const glm::dvec3 middle = copied ? glm::dvec3(0.0) : box.center;
      const double distance = glm::distance(viewer, glm::dvec3(room_from_node * glm::dvec4(middle, 1.0)));
      (draw.blended ? blended_ : opaque_).add(distance, i);
    }
  }
  opaque_.near_to_far(list.opaque);
  blended_.near_to_far(list.blended);
  std::reverse(list.blended.begin(), list.blended.end());
}

}  // namespace afm::render
