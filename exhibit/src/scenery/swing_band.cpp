// SPDX-License-Identifier: Apache-2.0
#include "scenery/swing_band.h"

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

#include "physics/beam_shape.h"

namespace afm::exhibit {

namespace {

constexpr float kUpwards = 0.5F;  // smallest component along z of a normal on the upper side

using Place = std::pair<float, float>;  // place seen from above

Place place_of(const scene::Vertex& vertex) { return {vertex.position.x, vertex.position.y}; }

using Triangle = std::array<scene::Vertex, 3>;

// Triangles of the lever's upper side.
std::vector<Triangle> upper_side(const scene::Mesh& lever) {
  std::vector<Triangle> triangles;
  for (const scene::Primitive& primitive : lever.primitives) {
    if (primitive.topology != scene::Topology::Triangles) continue;
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      const auto vertex = [&](std::size_t corner) { return primitive.vertices[primitive.indices[i + corner]]; };
      const Triangle triangle{vertex(0), vertex(1), vertex(2)};
      const glm::vec3 normal =
          glm::cross(triangle[1].position - triangle[0].position, triangle[2].position - triangle[0].position);
      if (normal.z > kUpwards * glm::length(normal)) triangles.push_back(triangle);
    }
  }
  return triangles;
}

// Builds the band's triangles, each seen from outside.
class Band {
 public:
  Band(double length, std::uint32_t material) : length_(length) { primitive_.material = material; }

  void add_triangle(const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    add(a, b, c, 1.0, 1.0, 1.0);
    add(a, c, b, -1.0, -1.0, -1.0);
    add_edge(a, b);
    add_edge(b, c);
    add_edge(c, a);
  }

  // With a wall along the outline: edges that one triangle alone has.
  scene::Primitive finish() {
    for (const auto& [ends, edge] : outline_) {
      add(edge.first, edge.second, edge.second, -1.0, -1.0, 1.0);
      add(edge.first, edge.second, edge.first, -1.0, 1.0, 1.0);
    }
    return std::move(primitive_);
  }

 private:
  void add_edge(const scene::Vertex& from, const scene::Vertex& to) {
    if (outline_.erase({place_of(to), place_of(from)}) == 0) outline_[{place_of(from), place_of(to)}] = {from, to};
  }

  void add(const scene::Vertex& a, const scene::Vertex& b, const scene::Vertex& c, double at_a, double at_b,
           double at_c) {
    for (const auto& [vertex, side] : {std::pair{a, at_a}, {b, at_b}, {c, at_c}}) {
      scene::Vertex& moved = primitive_.vertices.emplace_back();
      const double bend = side * physics::beam_deflection(static_cast<double>(vertex.position.x) / length_);
      moved.position = {vertex.position.x, vertex.position.y, static_cast<float>(bend)};
      primitive_.indices.push_back(static_cast<std::uint32_t>(primitive_.indices.size()));
    }
  }

  double length_;
  scene::Primitive primitive_;
  std::map<std::pair<Place, Place>, std::pair<scene::Vertex, scene::Vertex>> outline_;
};

}  // namespace

scene::Mesh swing_band(const scene::Mesh& lever, double length, std::uint32_t material) {
  Band band(length, material);
  for (const Triangle& triangle : upper_side(lever)) band.add_triangle(triangle);
  return {.name = "swing-band", .primitives = {band.finish()}};
}

}  // namespace afm::exhibit
