// SPDX-License-Identifier: Apache-2.0
#include "surface.h"

#include <cmath>
#include <utility>

namespace afm::generate {

namespace {

// Two triangles between the vertices a and b of one row, c and d of the next.
void add_quad(Surface& surface, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, Cut cut) {
  const auto drop = [&](std::uint32_t from, std::uint32_t to) {
    return std::abs(surface.vertices[from].position.z - surface.vertices[to].position.z);
  };
  if (cut == Cut::Alike || drop(a, d) <= drop(b, c)) {
    surface.add_triangle(a, b, d);
    surface.add_triangle(a, d, c);
  } else {
    surface.add_triangle(a, b, c);
    surface.add_triangle(b, d, c);
  }
}

}  // namespace

std::uint32_t Surface::add(const SurfaceVertex& vertex) {
  vertices.push_back(vertex);
  return static_cast<std::uint32_t>(vertices.size() - 1);
}

void Surface::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const V3 normal = cross(vertices[b].position - vertices[a].position, vertices[c].position - vertices[a].position);
  if (normal == V3{}) return;
  indices.insert(indices.end(), {a, b, c});
}

void Surface::add_grid(std::size_t rows, std::size_t columns,
                       const std::function<SurfaceVertex(std::size_t, std::size_t)>& at, Cut cut) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) add(at(row, column));
  }
  const auto width = static_cast<std::uint32_t>(columns);
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < width; ++column) {
      const std::uint32_t a = first + row * width + column, c = a + width;
      add_quad(*this, a, a + 1, c, c + 1, cut);
    }
  }
}

void Surface::paint(V3 color) {
  for (SurfaceVertex& vertex : vertices) vertex.color = color;
}

Outline circle(double radius, int halvings) {
  Outline outline;
  const V2 axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  for (int quarter = 0; quarter < 4; ++quarter) {
    const std::vector<V2> directions = arc(axes[quarter], axes[quarter + 1], halvings);
    for (std::size_t i = 0; i + 1 < directions.size(); ++i) {
      outline.push_back({directions[i] * radius, directions[i]});
    }
  }
  return outline;
}

Outline rounded_polygon(const std::vector<V2>& corners, double radius, int halvings) {
  Outline outline;
  const std::size_t count = corners.size();
  const auto outward = [&](std::size_t edge) {
    const V2 along = unit(corners[(edge + 1) % count] - corners[edge % count]);
    return V2{along.y, -along.x};
  };
  for (std::size_t i = 0; i < count; ++i) {
    const V2 before = outward(i + count - 1), after = outward(i);
    const V2 center = corners[i] - (before + after) * (radius / (1 + dot(before, after)));
    for (const V2 direction : arc(before, after, halvings)) outline.push_back({center + direction * radius, direction});
  }
  return outline;
}

Outline rounded_rectangle(V2 low, V2 high, double radius, int halvings) {
  return rounded_polygon({low, {high.x, low.y}, high, {low.x, high.y}}, radius, halvings);
}

Outline inset(const Outline& outline, double distance) {
  Outline result = outline;
  for (OutlinePoint& point : result) point.position = point.position - point.normal * distance;
  return result;
}

void add_loft(Surface& surface, const std::vector<Section>& sections) {
  surface.add_grid(sections.size(), sections.front().outline.size() + 1, [&](std::size_t row, std::size_t column) {
    const Section& section = sections[row];
    const OutlinePoint& point = section.outline[column % section.outline.size()];
    const V3 normal{point.normal.x * section.out, point.normal.y * section.out, section.up};
    return SurfaceVertex{{point.position.x, point.position.y, section.height}, unit(normal)};
  });
}

void add_cap(Surface& surface, const Outline& outline, double height, Facing facing) {
  V2 center;
  for (const OutlinePoint& point : outline)
    center = center + point.position * (1.0 / static_cast<double>(outline.size()));
  const V3 normal{0, 0, facing == Facing::Up ? 1.0 : -1.0};
  const std::uint32_t middle = surface.add({{center.x, center.y, height}, normal});
  for (const OutlinePoint& point : outline) surface.add({{point.position.x, point.position.y, height}, normal});
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t here = middle + 1 + i, next = middle + 1 + (i + 1) % count;
    if (facing == Facing::Up) {
      surface.add_triangle(middle, here, next);
    } else {
      surface.add_triangle(middle, next, here);
    }
  }
}

void add_lathe(Surface& surface, const std::vector<ProfilePoint>& profile, int halvings) {
  std::vector<Section> sections;
  for (const ProfilePoint& point : profile) {
    Outline outline = circle(1, halvings);
    for (OutlinePoint& corner : outline) corner.position = corner.position * point.radius;
    sections.push_back({std::move(outline), point.height, point.out, point.up});
  }
  add_loft(surface, sections);
}

void add_prism(Surface& surface, const Outline& outline, double low, double high, double bevel) {
  const Outline inner = inset(outline, bevel);
  add_loft(surface,
           {{inner, low, 0, -1}, {outline, low + bevel, 1, 0}, {outline, high - bevel, 1, 0}, {inner, high, 0, 1}});
  add_cap(surface, inner, low, Facing::Down);
  add_cap(surface, inner, high, Facing::Up);
}

Surface outline_of(const Outline& foot, double low, const Outline& rim, double high, double width) {
  Surface shell;
  const Outline around = inset(foot, -width);
  add_loft(shell, {{around, low - width, 1, 0}, {inset(rim, -width), high + width, 1, 0}});
  add_cap(shell, around, low - width, Facing::Down);
  for (std::size_t i = 0; i + 2 < shell.indices.size(); i += 3) std::swap(shell.indices[i], shell.indices[i + 1]);
  for (SurfaceVertex& vertex : shell.vertices) vertex.normal = vertex.normal * -1.0;
  return shell;
}

void add_placed(Surface& surface, const Surface& part, const Placement& placement) {
  const auto first = static_cast<std::uint32_t>(surface.vertices.size());
  for (SurfaceVertex vertex : part.vertices) {
    vertex.position = placement.origin + placement.direction(vertex.position);
    vertex.normal = placement.direction(vertex.normal);
    surface.add(vertex);
  }
  for (const std::uint32_t index : part.indices) surface.indices.push_back(first + index);
}

}  // namespace afm::generate
