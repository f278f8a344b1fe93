// SPDX-License-Identifier: Apache-2.0
#include "drawing/frame_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "core/check.h"

namespace afm::render {

namespace {

// Contact too far away to shade anything; the square of its distance is still finite.
constexpr glm::vec4 kNoContact(1e18F, 0.0F, 0.0F, 1.0F);

void write_contact(const ContactMark& mark, FrameBlock& block) {
  block.contact = kNoContact;
  if (!(mark.shade_radius_m > 0.0F)) {
    return;
  }
  block.contact = glm::vec4(mark.place_m, 1.0F / mark.shade_radius_m);
  block.contact_ring = glm::vec4(mark.ring_color, mark.ring_radius_m / mark.shade_radius_m);
}

void write_cone(const ConeShade& cone, FrameBlock& block) {
  block.cone_apex = glm::vec4(cone.apex_m, cone.radius_m);
  block.cone_axis = glm::vec4(cone.axis, cone.slope);
  block.cone_reach = glm::vec4(cone.height_m, cone.share, 0.0F, 0.0F);
}

void write_fog(const Fog& fog, FrameBlock& block) {
  const bool ranged = fog.end_m > fog.begin_m;
  block.fog = glm::vec4(fog.begin_m, ranged ? 1.0F / (fog.end_m - fog.begin_m) : 0.0F, fog.fade, ranged ? 1.0F : 0.0F);
  block.fog_axis = glm::vec4(glm::vec3(fog.away), static_cast<float>(-glm::dot(fog.away, fog.origin_m)));
}

// Direction in the room of a point on an eye's image, given in clip coordinates; ends on the near plane.
glm::dvec3 seen_at(const scene::EyeView& eye, double x, double y) {
  const glm::dvec4 place = glm::inverse(eye.projection) * glm::dvec4(x, y, 1.0, 1.0);
  return glm::transpose(glm::dmat3(eye.view)) * (glm::dvec3(place) / place.w);
}

void write_screen(const std::array<scene::EyeView, 2>& eyes, FrameBlock& block) {
  const auto between_eyes = [&](double x, double y) { return 0.5 * (seen_at(eyes[0], x, y) + seen_at(eyes[1], x, y)); };
  const glm::dvec3 corner = between_eyes(-1.0, -1.0);
  const double length = glm::length(corner);
  block.screen[0] = glm::vec4(glm::vec3(corner / length), 0.0F);
  block.screen[1] = glm::vec4(glm::vec3((between_eyes(1.0, -1.0) - corner) / length), 0.0F);
  block.screen[2] = glm::vec4(glm::vec3((between_eyes(-1.0, 1.0) - corner) / length), 0.0F);
}

}  // namespace

glm::mat4 shadow_from_room(const KeyLight& light) {
  const glm::dvec3 to_light = glm::normalize(glm::dvec3(light.direction_to_light));
  const glm::dvec3 helper = std::abs(to_light.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(helper, to_light));
  const glm::dvec3 up = glm::cross(to_light, right);
  const auto radius = static_cast<double>(light.shadow_radius_m);
  const glm::dvec3 center(light.shadow_center_m);

  // rows of the matrix: x and y span -1..1 across the sphere, z 0..1 along the light. y points down, as in the eyes;
  // otherwise the light would mistake back faces for front faces
  const glm::dvec3 rows[3]{right / radius, -up / radius, -to_light / (2.0 * radius)};
  glm::dmat4 m(1.0);
  for (glm::length_t row = 0; row < 3; ++row) {
    for (glm::length_t column = 0; column < 3; ++column) {
      m[column][row] = rows[row][column];
    }
    m[3][row] = -glm::dot(rows[row], center) + (row == 2 ? 0.5 : 0.0);
  }
  return glm::mat4(m);
}

namespace {

// KHR_lights_punctual, "Angular attenuation": scales and shifts the cosine of the angle to the cone's axis to 0..1.
glm::vec4 cone_of(const scene::PunctualLight& light) {
  if (light.kind != scene::PunctualLight::Kind::Spot) {
    return {0.0F, 1.0F, 0.0F, 0.0F};
  }
  const float outer = std::cos(light.outer_cone_rad);
  const float scale = 1.0F / std::max(0.001F, std::cos(light.inner_cone_rad) - outer);
  return {scale, -outer * scale, 0.0F, 0.0F};
}

void write_lights(const std::vector<PlacedLight>& lights, FrameBlock& block) {
  static_assert(kMostPlacedLights == AFM_MOST_LIGHTS);
  const std::size_t count = std::min(lights.size(), kMostPlacedLights);
  block.punctual_count.x = static_cast<float>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const PlacedLight& placed = lights[i];
    const bool directional = placed.light.kind == scene::PunctualLight::Kind::Directional;
    block.punctual_position[i] =
        glm::vec4(placed.position_m, placed.light.range_m ? 1.0F / *placed.light.range_m : 0.0F);
    block.punctual_direction[i] = glm::vec4(placed.direction, directional ? 0.0F : 1.0F);
    block.punctual_intensity[i] = glm::vec4(placed.light.intensity, 0.0F);
    block.punctual_cone[i] = cone_of(placed.light);
  }
}

}  // namespace

FrameBlock make_frame_block(const FrameState& frame, std::size_t first_eye, const glm::vec2& size, float guard_band) {
  const double shrink = 1.0 / static_cast<double>(guard_band);
  const glm::dmat4 guarded(glm::dvec4(shrink, 0, 0, 0), glm::dvec4(0, shrink, 0, 0), glm::dvec4(0, 0, 1, 0),
                           glm::dvec4(0, 0, 0, 1));
  FrameBlock block{};
  for (std::size_t view = 0; view < 2; ++view) {
    const std::size_t index = std::min(first_eye + view, std::size_t{1});
    const auto& eye = frame.eyes[index];
    block.clip_from_room[view] = glm::mat4(guarded * eye.projection * eye.view);
    block.eye_position[view] = glm::vec4(glm::vec3(eye.eye_position_m), static_cast<float>(index));
  }
  const auto& light = frame.key_light;
  block.shadow_from_room = shadow_from_room(light);
  const glm::vec3 to_light = glm::normalize(light.direction_to_light);
  const bool overhead = std::abs(to_light.y) > 0.9999F;
  block.light_direction = glm::vec4(to_light, light.map_share);
  block.light_side = glm::vec4(
      overhead ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::normalize(glm::cross(glm::vec3(0.0F, 1.0F, 0.0F), to_light)), 0.0F);
  block.light_radiance = glm::vec4(light.radiance, 2.0F * light.shadow_radius_m / static_cast<float>(kShadowMapSize));
  block.target_size = glm::vec4(size, 1.0F / size);
  write_screen(frame.eyes, block);
  write_contact(frame.contact, block);
  write_cone(frame.cone, block);
  write_fog(frame.fog, block);
  write_lights(frame.lights, block);
  return block;
}

glm::dmat3 normal_matrix(const glm::dmat4& room_from_node) {
  const glm::dmat3 linear(room_from_node);

  // the cofactor matrix is the inverse transpose up to the size of the determinant, and exists for flattened nodes too
  glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                      glm::cross(linear[0], linear[1]));
  const double longest = std::max({glm::length(cofactor[0]), glm::length(cofactor[1]), glm::length(cofactor[2])});
  if (!(longest > 0.0) || !std::isfinite(longest)) {
    return glm::dmat3(1.0);
  }
  const double mirrored = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
  return cofactor * (mirrored / longest);
}

void mark_highlighted(const FrameState& frame, const SceneGeometry& geometry, std::vector<std::uint8_t>& glowing) {
  const auto& parents = geometry.parents();
  glowing.assign(parents.size(), 0);
  for (const auto node : frame.highlighted) {
    AFM_CHECK(node < parents.size());
    glowing[node] = 1;
  }

  // parents come before their children
  for (std::size_t node = 0; node < parents.size(); ++node) {
    if (parents[node] && glowing[*parents[node]] != 0) {
      glowing[node] = 1;
    }
  }
}

glm::vec4 bend_of(const FrameState& frame, scene::NodeIndex node) {
  for (const auto& bend : frame.bends) {
    if (bend.node == node && bend.length > 0.0F) {
      return {1.0F / bend.length, bend.end_deflection, 0.0F, 0.0F};
    }
  }
  return glm::vec4(0.0F);
}

void write_draw_blocks(const FrameState& frame, const SceneGeometry& geometry, const std::vector<std::uint8_t>& glowing,
                       std::byte* blocks, std::size_t stride) {
  const auto& draws = geometry.draws();
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const auto node = draws[i].node;
    DrawBlock block = draws[i].block;
    const auto flag = [node](const std::vector<scene::NodeIndex>& nodes) {
      return std::find(nodes.begin(), nodes.end(), node) != nodes.end() ? 1.0F : 0.0F;
    };
    const auto& room_from_node = frame.room_from_node[node];
    block.room_from_node = glm::mat4(room_from_node);
    const glm::mat3 normals(normal_matrix(room_from_node));
    for (glm::length_t column = 0; column < 3; ++column) {
      block.normal_column[column] = glm::vec4(normals[column], 0.0F);
    }
    block.emissive.a = glowing[node] != 0 ? 1.0F : 0.0F;
    block.surface.w = flag(frame.unshadowed);
    block.bend = bend_of(frame, node);
    block.bend.z = flag(frame.outlined);
    std::memcpy(blocks + i * stride, &block, sizeof(block));
  }
}

}  // namespace afm::render
