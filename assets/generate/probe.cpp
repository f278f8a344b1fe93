// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "models.h"
#include "probe_parts.h"

namespace afm::generate {
namespace {

constexpr double kUm = 1e-6;

// A soft contact lever as sold for liquids and force curves: V-shaped Si3N4, gold on its back.
constexpr double kLength = 200 * kUm;
constexpr double kHalfBase = 90 * kUm;
constexpr double kLegAcross = 32.5 * kUm;  // width along y; 30 um across the leg
constexpr double kNarrowing = 0.4;         // dy/dx of the outer edge
constexpr double kTrueThickness = 0.6 * kUm;
constexpr double kDrawnThickness = 2 * kUm;  // drawn instead of the true thickness, which would vanish at a distance
constexpr double kLeverBevel = 0.5 * kUm;
constexpr double kTipX = 194 * kUm;

// The tip: a square pyramid whose faces lean 17.5 degrees from its axis, as a moulded nitride tip's do on the sides
// (Bruker, data sheet of DNP probes), with its sharp apex rounded by a ball.
constexpr double kTipHalfBase = 2 * kUm;
constexpr double kSharpHeight = 6.343 * kUm;
constexpr double kApexRadius = 0.05 * kUm;

// The chip's front: a slab with the 54.7 degree flanks of a {111} etch, whose tangent is sqrt(2).
constexpr double kChipLength = 300 * kUm;
constexpr double kChipHalfWidth = 130 * kUm;
constexpr double kChipHeight = 80 * kUm;

MaterialSpec nitride() { return {.name = "silicon nitride", .base_color = {0.62, 0.40, 0.13}, .roughness = 0.24}; }
MaterialSpec gold() {
  return {.name = "gold coating", .base_color = {1.0, 0.77, 0.34}, .metallic = 1, .roughness = 0.22};
}
MaterialSpec silicon() {
  return {.name = "silicon", .base_color = {0.30, 0.32, 0.37}, .metallic = 0.85, .roughness = 0.34};
}

// One station of a leg, seen from above: the outer edge and the inner one, with their outward normals.
struct Station {
  double x = 0;
  double outer = 0, inner = 0;
  bool beside_cut = false;
  V2 outer_normal{};
};

// Half of the lever from the clamp to its round end, y >= 0. Past the cut-out the inner edge is the middle line.
std::vector<Station> lever_stations() {
  constexpr int kStraight = 40, kEndHalvings = 3;
  const V2 normal = unit(V2{kNarrowing, 1});

  // the end's circle touches both outer edges and ends at the lever's length
  const double radius = (kHalfBase - kNarrowing * kLength) * normal.y / (1 - kNarrowing * normal.y);
  const double center = kLength - radius;
  const double tangent = center + radius * normal.x;
  std::vector<Station> stations;
  for (int i = 0; i <= kStraight; ++i) {
    const double x = tangent * i / kStraight;
    stations.push_back({.x = x, .outer = kHalfBase - kNarrowing * x, .outer_normal = normal});
  }
  const std::vector<V2> round = arc(normal, {1, 0}, kEndHalvings);
  for (std::size_t i = 1; i < round.size(); ++i) {
    stations.push_back({.x = center + radius * round[i].x, .outer = radius * round[i].y, .outer_normal = round[i]});
  }

  // the cut-out ends in a point between two stations; the nearer one moves there
  const double cut_end = (kHalfBase - kLegAcross) / kNarrowing;
  for (Station& station : stations) {
    if (std::abs(station.x - cut_end) <= tangent / kStraight / 2) {
      station.x = cut_end;
      station.outer = kHalfBase - kNarrowing * cut_end;
    }
    station.beside_cut = station.x <= cut_end;
    station.inner = station.x < cut_end ? kHalfBase - kNarrowing * station.x - kLegAcross : 0;
  }
  return stations;
}

// A ribbon along the lever: `profile` gives for each station the points across, in order from right to left as seen
// from outside when looking along +x.
void add_ribbon(Surface& surface, const std::vector<Station>& stations, std::size_t across,
                const std::function<SurfaceVertex(const Station&, std::size_t)>& profile) {
  surface.add_grid(across, stations.size(),
                   [&](std::size_t row, std::size_t column) { return profile(stations[column], row); });
}

SurfaceVertex mirrored(SurfaceVertex vertex) {
  vertex.position.y = -vertex.position.y;
  vertex.normal.y = -vertex.normal.y;
  return vertex;
}

// The surface for y >= 0 and its mirror image.
Surface both_sides(const Surface& half) {
  Surface whole = half;
  const auto count = static_cast<std::uint32_t>(half.vertices.size());
  for (const SurfaceVertex& vertex : half.vertices) whole.add(mirrored(vertex));
  for (std::size_t i = 0; i < half.indices.size(); i += 3) {
    whole.indices.insert(whole.indices.end(),
                         {half.indices[i] + count, half.indices[i + 2] + count, half.indices[i + 1] + count});
  }
  return whole;
}

// The ball's centre below the base and the pyramid's face normals. The rounded pyramid is the sum of a smaller pyramid
// and a ball: flat faces, edges that are cylinders, and a spherical cap between the four face normals.
struct TipShape {
  V3 center;
  V3 face_normal[4];
};

TipShape tip_shape() {
  const V3 face = unit({kSharpHeight, 0, -kTipHalfBase});
  const double depth = kSharpHeight - kApexRadius / -face.z;
  return {{0, 0, -depth}, {{face.x, 0, face.z}, {0, face.x, face.z}, {-face.x, 0, face.z}, {0, -face.x, face.z}}};
}

double apex_height() { return tip_shape().center.z - kApexRadius; }

// The flat faces, the rounded edges between them, and the base; `shares` are the edges' stations from one face to the
// next.
Surface sides_of_tip(const std::vector<double>& shares) {
  const TipShape shape = tip_shape();
  Surface surface;

  // point where the line from the ball along an edge or face meets the base, for the normal there
  const auto at_base = [&](V3 normal, V3 edge) {
    const V3 start = shape.center + normal * kApexRadius;
    return start + edge * (-start.z / edge.z);
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const V3 before = shape.face_normal[k], after = shape.face_normal[(k + 1) % 4];
    const V3 edge = cross(before, after);
    surface.add_grid(2, shares.size(), [&](std::size_t row, std::size_t column) {
      const V3 normal = unit(mix(before, after, shares[column]));
      return SurfaceVertex{row == 0 ? shape.center + normal * kApexRadius : at_base(normal, edge), normal};
    });

    // the face between this edge and the one before
    const V3 edge_before = cross(shape.face_normal[(k + 3) % 4], before);
    const std::uint32_t corner = surface.add({shape.center + before * kApexRadius, before});
    const std::uint32_t left = surface.add({at_base(before, edge_before), before});
    const std::uint32_t right = surface.add({at_base(before, edge), before});
    surface.add_triangle(corner, right, left);
  }

  // the base, seen when the tip is drawn larger than the lever
  Outline base;
  for (std::size_t k = 0; k < 4; ++k) {
    const V3 before = shape.face_normal[k], after = shape.face_normal[(k + 1) % 4];
    for (const V3 normal : {before, after}) {
      const V3 corner = at_base(normal, cross(before, after));
      base.push_back({{corner.x, corner.y}, {normal.x, normal.y}});
    }
  }
  add_cap(surface, base, 0, Facing::Up);

  return surface;
}

V3 normal_of_cap(const TipShape& shape, double u, double v) {
  return unit(
      mix(mix(shape.face_normal[0], shape.face_normal[3], u), mix(shape.face_normal[1], shape.face_normal[2], u), v));
}

// A square of great arcs between the four faces.
Surface tip_cap(const std::vector<double>& shares) {
  const TipShape shape = tip_shape();
  Surface surface;
  surface.add_grid(shares.size(), shares.size(), [&](std::size_t row, std::size_t column) {
    const V3 normal = normal_of_cap(shape, shares[column], shares[row]);
    return SurfaceVertex{shape.center + normal * kApexRadius, normal};
  });
  return surface;
}

std::vector<double> even_shares() {
  constexpr int kSteps = 36;
  std::vector<double> shares;
  for (int i = 0; i <= kSteps; ++i) shares.push_back(static_cast<double>(i) / kSteps);
  return shares;
}

Surface tip_surface() {
  Surface surface = sides_of_tip(even_shares());
  add_placed(surface, tip_cap(even_shares()), {});
  return surface;
}

Surface from_apex(const Surface& surface) {
  Surface result;
  add_placed(result, surface, {{0, 0, -apex_height()}});
  return result;
}

std::vector<Part> chip() {
  const double slope = kChipHeight / std::sqrt(2.0), round = 12 * kUm, bevel = 4 * kUm;
  const double low = kDrawnThickness, high = low + kChipHeight;
  const V2 foot_low{-kChipLength, -kChipHalfWidth}, foot_high{0, kChipHalfWidth};
  const Outline foot = rounded_rectangle(foot_low, foot_high, round, 3);
  const Outline edge = rounded_rectangle(foot_low + V2{slope, slope}, foot_high - V2{slope, slope}, round, 3);
  const Outline lip = inset(foot, -bevel / 2);
  Surface block;
  add_loft(block,
           {{foot, low, std::sqrt(2.0), 1}, {edge, high - bevel, std::sqrt(2.0), 1}, {inset(edge, bevel), high, 0, 1}});
  add_cap(block, inset(edge, bevel), high, Facing::Up);

  // the nitride film that the lever was etched from goes on under the chip
  Surface film;
  add_prism(film, lip, 0, low, kLeverBevel);
  return {{std::move(block), silicon()}, {std::move(film), nitride()}};
}

}  // namespace

std::vector<Part> cantilever() {
  const std::vector<Station> stations = lever_stations();
  const double top = kDrawnThickness, shoulder = top - kLeverBevel;
  const V2 inner_normal = unit(V2{-kNarrowing, -1});

  // the gold back with its rounded edges: cut-out's edge, flat, outer edge
  Surface back;
  add_ribbon(back, stations, 4, [&](const Station& s, std::size_t row) {
    const double rim_x = s.x - s.outer_normal.x * kLeverBevel;
    const double rim = std::max(s.outer - s.outer_normal.y * kLeverBevel, 0.0);
    switch (row) {
      case 0:
        if (!s.beside_cut) return SurfaceVertex{{rim_x, 0, top}, {0, 0, 1}};
        return SurfaceVertex{{s.x, s.inner, shoulder}, {inner_normal.x, inner_normal.y, 0}};
      case 1:
        if (!s.beside_cut) return SurfaceVertex{{rim_x, 0, top}, {0, 0, 1}};
        return SurfaceVertex{{s.x, s.inner + kLeverBevel, top}, {0, 0, 1}};
      case 2:
        return SurfaceVertex{{rim_x, rim, top}, {0, 0, 1}};
      default:
        return SurfaceVertex{{s.x, s.outer, shoulder}, {s.outer_normal.x, s.outer_normal.y, 0}};
    }
  });

  Surface body;
  add_ribbon(body, stations, 2, [&](const Station& s, std::size_t row) {  // outer wall, from the shoulder down
    return SurfaceVertex{{s.x, s.outer, row == 0 ? shoulder : 0}, {s.outer_normal.x, s.outer_normal.y, 0}};
  });
  add_ribbon(body, stations, 2,
             [&](const Station& s, std::size_t row) {  // underside, from the outer edge to the inner one
               return SurfaceVertex{{s.x, row == 0 ? s.outer : s.inner, 0}, {0, 0, -1}};
             });
  std::vector<Station> cut_out;
  for (const Station& station : stations) {
    cut_out.push_back(station);
    if (station.inner <= 0) break;
  }
  add_ribbon(body, cut_out, 2, [&](const Station& s, std::size_t row) {  // the cut-out's wall, upwards
    return SurfaceVertex{{s.x, s.inner, row == 0 ? 0 : shoulder}, {inner_normal.x, inner_normal.y, 0}};
  });
  return {{both_sides(body), nitride()}, {both_sides(back), gold()}};
}

double lever_tip_x() { return kTipX; }
double lever_thickness() { return kDrawnThickness; }
Surface tip_sides(const std::vector<double>& shares) { return from_apex(sides_of_tip(shares)); }
V3 cap_normal(double u, double v) { return normal_of_cap(tip_shape(), u, v); }
double tip_length() { return -apex_height(); }
double tip_radius() { return kApexRadius; }

void add_atom(Surface& surface, V3 center, double radius, Facing facing, V3 color, Roundness roundness) {
  // rings from the pole to 112 degrees from it; the neighbours take the light from what lies low
  const std::vector<V2> rings = arc({1, 0}, {-0.37460659341591201, 0.92718385456678742}, roundness.rings);
  const Outline around = circle(1, roundness.around);
  const double side = facing == Facing::Up ? 1 : -1;
  const auto vertex = [&](V3 normal, double height) {
    return SurfaceVertex{center + normal * radius, normal, color * mix(0.12, 1, smooth_step(-0.5, 0.9, height))};
  };
  const std::uint32_t pole = surface.add(vertex({0, 0, side}, 1));
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const V2 ring = rings[i];
    for (const OutlinePoint& point : around) {
      surface.add(vertex({point.position.x * ring.y, side * point.position.y * ring.y, side * ring.x}, ring.x));
    }
  }
  const auto count = static_cast<std::uint32_t>(around.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t here = pole + 1 + i, next = pole + 1 + (i + 1) % count;
    surface.add_triangle(pole, here, next);
    for (std::uint32_t ring = 1; ring + 1 < rings.size(); ++ring) {
      const std::uint32_t outwards = ring * count;
      surface.add_triangle(here + outwards - count, here + outwards, next + outwards);
      surface.add_triangle(here + outwards - count, next + outwards, next + outwards - count);
    }
  }
}

Model probe() {
  Model model{"probe", {}};
  model.nodes.push_back({.name = "probe", .placement = kYUpFromZUp});
  model.nodes.push_back({.name = "chip", .parent = 0, .parts = chip()});
  model.nodes.push_back({.name = "cantilever",
                         .parent = 0,
                         .parts = cantilever(),
                         .extras = {{"length_m", kLength},
                                    {"tip_x_m", kTipX},
                                    {"base_width_m", 2 * kHalfBase},
                                    {"thickness_m", kTrueThickness},
                                    {"drawn_thickness_m", kDrawnThickness}}});
  model.nodes.push_back({.name = "tip",
                         .parent = 2,
                         .placement = Placement{{kTipX, 0, 0}},
                         .parts = {{tip_surface(), nitride()}},
                         .extras = {{"base_m", 2 * kTipHalfBase}, {"height_m", -apex_height()}}});
  model.nodes.push_back({.name = "apex",
                         .parent = 3,
                         .placement = Placement{{0, 0, apex_height()}},
                         .extras = {{"radius_m", kApexRadius}}});
  return model;
}

}  // namespace afm::generate
