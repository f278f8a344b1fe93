// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/particle_models.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "exhibit/models/height_colours.h"
#include "models/linear_colour.h"

namespace afm::exhibit {

namespace {

constexpr int kSphereRings = 14, kSphereSectors = 28;
constexpr int kRingSectors = 48, kRingSides = 8;
constexpr int kTipSectors = 40, kTipCapRings = 8, kTipFlankRings = 4;
constexpr double kRingRadius = 1.3, kRingThickness = 0.09;  // size in radii of the particle
constexpr double kFootprintRadius = 0.7, kFootprintThickness = 0.05, kDotRadius = 0.13;
constexpr double kCrossReach = 0.6, kCrossHalfWidth = 0.06, kCrossHeight = 0.03;
constexpr int kDotRings = 6, kDotSectors = 10;
constexpr int kRodSectors = 20, kRodEndRings = 6, kRodSideRings = 10;
constexpr int kIslandSectors = 48, kIslandRimRings = 8, kIslandFlatRings = 2;
constexpr double kIslandMark = 0.045;  // half width of the mark, as a fraction of a turn
constexpr double kPadHeight = 0.08;    // height in radii of the particle
constexpr double kBandWidth = 0.42;    // half width of the dark band, sine of the latitude
constexpr double kCapLatitude = 0.86;  // sine of the latitude of the cap's edge
constexpr Srgb kPlain{255, 255, 255}, kBand{92, 62, 40}, kCap{150, 205, 235};
// Thickness relative to the side, as for the assets' samples: a thinner one would lift the table before the panels.
constexpr double kGroundThickness = 0.18;

// A grid of vertices on a closed surface: rows from one end to the other, columns around. `at` returns place and
// normal.
struct Point {
  glm::dvec3 place, normal;
  glm::vec4 color{1.0F};
};
scene::Primitive rolled(int rows, int columns, const std::function<Point(double row, double column)>& at) {
  scene::Primitive surface;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const Point point = at(static_cast<double>(row) / rows, static_cast<double>(column) / columns);
      surface.vertices.push_back({glm::vec3(point.place), glm::vec3(point.normal), point.color});
    }
  }
  const auto width = static_cast<std::uint32_t>(columns) + 1;
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
    for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(columns); ++column) {
      const std::uint32_t first = row * width + column, above = first + width;
      surface.indices.insert(surface.indices.end(), {first, first + 1, above, above, first + 1, above + 1});
    }
  }
  return surface;
}

glm::dvec3 around(double column, double radius, double z) {
  const double angle = 2.0 * std::numbers::pi * column;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

scene::Scene one_mesh(const char* name, scene::PbrMaterial material, scene::Primitive primitive) {
  scene::Scene scene;
  scene.materials.push_back(std::move(material));
  scene.meshes.push_back({name, {std::move(primitive)}});
  scene.nodes.push_back({name, std::nullopt, 0U, glm::dmat4(1.0)});
  return scene;
}

// Bands that no rotation but that about their axis leaves as they are, and a cap at one end of the axis, so that this
// rotation alone is unseen.
glm::vec4 color_at(double sine_of_latitude) {
  if (sine_of_latitude > kCapLatitude) return linear_colour(kCap);
  return linear_colour(std::abs(sine_of_latitude) < 0.5 * kBandWidth ? kBand : kPlain);
}

// Ball whose vertices have the colour `color` of the sine of their latitude.
scene::Primitive ball(int rows, int columns, double radius, glm::vec4 (*color)(double)) {
  return rolled(rows, columns, [&](double row, double column) {
    const double latitude = std::numbers::pi * (row - 0.5);
    const glm::dvec3 normal = around(column, std::cos(latitude), std::sin(latitude));
    return Point{radius * normal, normal, color(std::sin(latitude))};
  });
}

// Ring about the z axis, its middle at the height `z`.
scene::Primitive ring(double radius, double thickness, double z) {
  return rolled(kRingSides, kRingSectors, [&](double row, double column) {
    const double angle = 2.0 * std::numbers::pi * row;
    const glm::dvec3 outwards = around(column, std::cos(angle), std::sin(angle));
    return Point{around(column, radius, z) + thickness * outwards, outwards};
  });
}

// Cuboid without a lower face.
scene::Primitive slab(const glm::dvec3& size, const glm::dvec3& middle) {
  scene::Primitive slab;
  const auto face = [&](const glm::dvec3& normal, const glm::dvec3& right, const glm::dvec3& up) {
    const auto first = static_cast<std::uint32_t>(slab.vertices.size());
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
      const glm::dvec3 place = normal + corner.x * right + corner.y * up;
      slab.vertices.push_back({glm::vec3(0.5 * size * place + middle), glm::vec3(normal)});
    }
    slab.indices.insert(slab.indices.end(), {first, first + 1, first + 2, first + 2, first + 1, first + 3});
  };
  face({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  face({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  face({-1, 0, 0}, {0, -1, 0}, {0, 0, 1});
  face({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
  face({0, -1, 0}, {1, 0, 0}, {0, 0, 1});
  return slab;
}

scene::PbrMaterial mark_on_sample() {
  return {.name = "mark on the sample", .base_color = {0.85F, 0.88F, 0.90F, 1.0F}, .metallic = 0.0F, .roughness = 0.8F};
}

}  // namespace

scene::Scene particle_ground(double side_m) {
  const double depth = kGroundThickness * side_m;
  return one_mesh("surface",
                  {.name = "ground", .base_color = {0.30F, 0.34F, 0.37F, 1.0F}, .metallic = 0.0F, .roughness = 0.55F},
                  slab({side_m, side_m, depth}, {0.0, 0.0, -0.5 * depth}));
}

scene::Scene particle_target() {
  scene::Primitive cross = slab({2.0 * kCrossReach, 2.0 * kCrossHalfWidth, 2.0 * kCrossHeight}, glm::dvec3(0.0));
  const scene::Primitive other = slab({2.0 * kCrossHalfWidth, 2.0 * kCrossReach, 2.0 * kCrossHeight}, glm::dvec3(0.0));
  const auto first = static_cast<std::uint32_t>(cross.vertices.size());
  cross.vertices.insert(cross.vertices.end(), other.vertices.begin(), other.vertices.end());
  std::transform(other.indices.begin(), other.indices.end(), std::back_inserter(cross.indices),
                 [first](std::uint32_t index) { return first + index; });
  return one_mesh("target", mark_on_sample(), std::move(cross));
}

scene::Scene particle_sphere() {
  return one_mesh("sphere", {.name = "particle", .metallic = 0.0F, .roughness = 0.4F},
                  ball(kSphereRings, kSphereSectors, 1.0, color_at));
}

scene::Scene particle_rod(double length) {
  const int rows = 2 * kRodEndRings + kRodSideRings;
  scene::Primitive rod = rolled(rows, kRodSectors, [&](double row, double column) {
    const double at = row * rows, side = std::clamp((at - kRodEndRings) / kRodSideRings, 0.0, 1.0);
    const double end =
        at <= kRodEndRings ? at / kRodEndRings - 1.0 : std::max(0.0, at - kRodEndRings - kRodSideRings) / kRodEndRings;
    const double latitude = 0.5 * std::numbers::pi * end;
    const glm::dvec3 normal = around(column, std::cos(latitude), std::sin(latitude));
    const glm::dvec3 place = normal + glm::dvec3(0, 0, length * (side - 0.5));
    return Point{{place.z, place.x, place.y}, {normal.z, normal.x, normal.y}, linear_colour(end > 0.0 ? kCap : kPlain)};
  });
  return one_mesh("rod", {.name = "rod", .metallic = 0.0F, .roughness = 0.4F}, std::move(rod));
}

scene::Scene particle_island(double core) {
  const int rows = kIslandRimRings + 2 * kIslandFlatRings;
  scene::Primitive island = rolled(rows, kIslandSectors, [&](double row, double column) {
    // from below to above
    const double at = row * rows - kIslandFlatRings, rim = std::clamp(at / kIslandRimRings, 0.0, 1.0);
    const double inwards = std::max({-at, at - kIslandRimRings, 0.0}) / kIslandFlatRings;
    const double latitude = std::numbers::pi * (rim - 0.5);
    const glm::dvec3 normal = around(column, std::cos(latitude), std::sin(latitude));
    const glm::dvec3 place = around(column, core * (1.0 - inwards), 0.0) + normal;
    const bool mark = std::min(column, 1.0 - column) < kIslandMark;
    return Point{place, normal, linear_colour(mark ? kBand : kPlain)};
  });
  return one_mesh("island", {.name = "island", .metallic = 0.0F, .roughness = 0.4F}, std::move(island));
}

scene::Scene particle_pad(double width, double height) {
  return one_mesh("pad",
                  {.name = "electrode", .base_color = {0.80F, 0.62F, 0.25F, 1.0F}, .metallic = 0.5F, .roughness = 0.4F},
                  slab({width, height, 2.0 * kPadHeight}, glm::dvec3(0.0)));
}

scene::Scene particle_sticky_pad(double width, double height) {
  return one_mesh(
      "pad", {.name = "sticky pad", .base_color = {0.34F, 0.22F, 0.46F, 1.0F}, .metallic = 0.0F, .roughness = 0.9F},
      slab({width, height, 2.0 * kPadHeight}, glm::dvec3(0.0)));
}

scene::Scene particle_ring() {
  return one_mesh("ring",
                  {.name = "ring of the touched particle",
                   .base_color = {1.0F, 0.85F, 0.15F, 1.0F},
                   .emissive = {0.35F, 0.28F, 0.03F},
                   .metallic = 0.0F,
                   .roughness = 0.5F},
                  ring(kRingRadius, kRingThickness, kRingThickness));
}

// Ring, half of which lies in the sample.
scene::Scene particle_footprint() {
  return one_mesh("footprint", mark_on_sample(), ring(kFootprintRadius, kFootprintThickness, 0.0));
}

scene::Scene particle_dot() {
  return one_mesh("dot", mark_on_sample(),
                  ball(kDotRings, kDotSectors, kDotRadius, [](double) { return glm::vec4(1.0F); }));
}

scene::Scene particle_tip(double half_angle_rad, double height) {
  // the ball passes into the cone where its normal points down by the half angle
  const double sine = std::sin(half_angle_rad), cosine = std::cos(half_angle_rad);
  const double joint_z = 1.0 - sine, joint_radius = cosine;
  const int flank_end = kTipCapRings + kTipFlankRings, rows = flank_end + 2;  // rows; the last two close the top
  const double flank = std::max(height - joint_z, 0.0);
  scene::Primitive tip = rolled(rows, kTipSectors, [&](double row, double column) {
    const double at = row * rows;
    if (at <= kTipCapRings) {
      const double down = (0.5 * std::numbers::pi - half_angle_rad) * (1.0 - at / kTipCapRings) + half_angle_rad;
      const glm::dvec3 normal = around(column, std::cos(down), -std::sin(down));
      return Point{normal + glm::dvec3(0, 0, 1), normal};
    }
    if (at > flank_end) {
      const double radius = at < rows ? joint_radius + flank * sine / cosine : 0.0;
      return Point{around(column, radius, joint_z + flank), glm::dvec3(0, 0, 1)};
    }
    const double up = (at - kTipCapRings) / kTipFlankRings * flank;
    return Point{around(column, joint_radius + up * sine / cosine, joint_z + up), around(column, cosine, -sine)};
  });
  return one_mesh(
      "tip",
      {.name = "tip of true size", .base_color = {0.55F, 0.58F, 0.63F, 1.0F}, .metallic = 0.0F, .roughness = 0.45F},
      std::move(tip));
}

}  // namespace afm::exhibit
