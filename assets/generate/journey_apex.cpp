// SPDX-License-Identifier: Apache-2.0
#include "journey_apex.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "probe_parts.h"

namespace afm::generate {
namespace {

constexpr double kNm = 1e-9;
constexpr V3 kAmber{0.62, 0.40, 0.13}, kNitrogen{0.16, 0.28, 0.75}, kSilicon{0.80, 0.66, 0.42};
constexpr V3 kLitBelow{1.0, 0.78, 0.42};  // amber in the light of the sample, which is so near there
constexpr double kShell = 0.1 * kNm;
constexpr double kBetweenAtoms = 0.05 * kNm;  // depth of the ball where atoms are out of it

// mesh of the cap: rings whose radii grow by a constant ratio
constexpr int kStations = 40;  // from one face to the next
constexpr double kInnermost = 0.01, kRingRatio = 1.05;

// Clusters: the widths that are shown, each from the first to the last distance, in widths.
constexpr double kWidest = 8 * kNm, kNarrowest = 0.8 * kNm, kStep = 0.7;
constexpr double kFirst = 3, kWhole = 4.5, kFading = 6, kLast = 9;
constexpr double kDepth = 0.26;                              // between two of them, in widths
constexpr double kCloseFrom = 4 * kNm, kCloseTo = 14 * kNm;  // from there inwards the ball has its atoms' colours

constexpr double kLitFrom = 20 * kNm, kLitTo = 55 * kNm;

// Atoms: reach to the sides, towards the viewer (negative y) and away.
constexpr double kSpacing = 0.30 * kNm, kRadius = 0.17 * kNm;
constexpr double kReachAside = 10 * kNm, kReachBefore = 7 * kNm, kReachBehind = 2.4 * kNm;

// Atoms that the viewer passes at a small distance.
constexpr double kNearest = 1.2 * kNm, kSeenFromBelow = 2.2 * kNm, kNearAside = 3 * kNm;

// A place on the ball in a map of equal areas about its lowest point.
V2 place_of(V3 normal) {
  const double flat = std::sqrt(normal.x * normal.x + normal.y * normal.y);
  const double r = tip_radius() * std::sqrt(std::max(0.0, 2 * (1 + normal.z)));
  return V2{normal.x, normal.y} * (r / std::max(flat, 1e-12));
}

V3 normal_at(V2 place) {
  const double q = dot(place, place) / (tip_radius() * tip_radius());
  const V2 flat = place * (std::sqrt(1 - q / 4) / tip_radius());
  return {flat.x, flat.y, q / 2 - 1};
}

struct Cluster {
  double height = 0;  // 0 to 1
  double kind = 0;    // random, alike all over the cluster
};

// Round clusters, one in each cell of a jittered triangular lattice.
Cluster cluster_at(V2 at, std::uint32_t seed) {
  const double row_at = at.y / std::sqrt(0.75);
  const auto row = static_cast<std::int64_t>(std::floor(row_at + 0.5));
  double weights = 0, kind = 0, away_sum = 0;
  for (std::int64_t k = row - 2; k <= row + 2; ++k) {
    const double shift = k % 2 != 0 ? 0.5 : 0.0;
    const auto column = static_cast<std::int64_t>(std::floor(at.x - shift + 0.5));
    for (std::int64_t i = column - 2; i <= column + 2; ++i) {
      const double dx = static_cast<double>(i) + shift + 0.6 * (random_unit(i, k, seed) - 0.5) - at.x;
      const double dy = (static_cast<double>(k) + 0.6 * (random_unit(i, k, seed + 1) - 0.5)) * std::sqrt(0.75) - at.y;
      const double size = mix(0.45, 0.68, random_unit(i, k, seed + 2));
      const double away = (dx * dx + dy * dy) / (size * size) + 0.02;
      const double near = 1 / (away * away), weight = near * near * near;  // joins them without a kink
      weights += weight;
      away_sum += weight * away;
      kind += weight * random_unit(i, k, seed + 3);
    }
  }
  return {std::sqrt(std::max(0.0, 1 - std::min(1.0, 0.8 * away_sum / weights))), kind / weights};
}

struct Ball {
  double depth = 0;  // metres below the smooth ball
  Cluster mean{1, 0.5};
};

// Distance from the middle of the atoms that are out of the ball, 1 where the last ones are.
double among_atoms(V2 at) {
  const double x = at.x / kReachAside, y = at.y / (at.y < 0 ? kReachBefore : kReachBehind);
  return std::sqrt(x * x + y * y);
}

double beyond_atoms(V2 at) { return smooth_step(0.95, 1.3, among_atoms(at)); }

// The clusters of the widths that suit the distance, faded into each other; none at the cap's edge.
Ball ball_at(V3 normal, double to_edge) {
  const V2 place = place_of(normal);
  const double r = std::sqrt(dot(place, place));
  double weights = 1e-9, depth = 0, height = 1e-9, kind = 0.5e-9;
  std::uint32_t seed = 110;
  for (double width = kWidest; width >= kNarrowest; width *= kStep, seed += 4) {
    const double ratio = r / width;
    const double weight = smooth_step(kFirst, kWhole, ratio) * (1 - smooth_step(kFading, kLast, ratio));
    if (weight <= 0) continue;
    const Cluster cluster = cluster_at(place * (1 / width), seed);
    depth += weight * kDepth * width * (1 - cluster.height);
    height += weight * cluster.height;
    kind += weight * cluster.kind;
    weights += weight;
  }
  const double share = (1 - smooth_step(0.3, 0.9, to_edge)) * beyond_atoms(place);
  const double among = kBetweenAtoms * (1 - beyond_atoms(place)) * smooth_step(0, 2 * kNm, r);
  return {share * depth / std::max(weights, 1.0) + among,
          {mix(1, height / weights, share), mix(0.5, kind / weights, share)}};
}

SurfaceVertex vertex_at(V3 normal, double to_edge) {
  const auto at = [&](V3 n) { return V3{0, 0, tip_radius()} + n * (tip_radius() - ball_at(n, to_edge).depth); };
  const Ball ball = ball_at(normal, to_edge);
  const double r = std::sqrt(dot(place_of(normal), place_of(normal)));
  const V3 side = unit(cross(normal, std::abs(normal.x) < 0.7 ? V3{1, 0, 0} : V3{0, 1, 0}));
  const V3 other = cross(normal, side);
  const double step = std::max(0.02 * r, 0.02 * kNm) / tip_radius();
  const V3 along = at(unit(normal + side * step)) - at(unit(normal - side * step));
  const V3 across = at(unit(normal + other * step)) - at(unit(normal - other * step));
  const V3 shaded = unit(cross(along, across));
  const V3 close = mix(kNitrogen, kSilicon, mix(0.4, 1, ball.mean.kind));
  const V3 far = kAmber * mix(0.65, 1.35, ball.mean.kind);
  const V3 lit = mix(close * 1.25, kLitBelow * mix(0.6, 1, ball.mean.kind), smooth_step(kCloseFrom, kCloseTo, r));
  const V3 own = mix(lit, far, smooth_step(kLitFrom, kLitTo, r));
  return {at(normal), dot(shaded, normal) < 0 ? shaded * -1 : shaded,
          own * mix(0.1, 1, ball.mean.height * ball.mean.height)};
}

// How deep an atom is in the ball: the farther from the lowest point, the fewer are out of it.
double sunk(V2 at, std::int64_t column, std::int64_t row) {
  const double until = mix(0.7, 1, random_unit(column, row, 84));
  return 2.5 * kShell * smooth_step(-0.03, 0.03, among_atoms(at) - until);
}

}  // namespace

double atom_shell() { return kShell; }

std::vector<double> apex_shares() {
  std::vector<double> shares;
  for (int i = 0; i <= kStations; ++i) shares.push_back(static_cast<double>(i) / kStations);
  return shares;
}

std::vector<Part> apex() {
  // rays from the lowest point, in the cap's shares, to all stations of its edge
  std::vector<V2> rays;
  for (const double share : apex_shares()) rays.push_back({2 * share - 1, -1});
  for (std::size_t side = 1; side < 4; ++side) {
    const std::size_t first = rays.size() - kStations;
    for (std::size_t i = 0; i < kStations; ++i) rays.push_back({-rays[first + i].y, rays[first + i].x});
  }
  std::vector<double> rings{0};
  for (double ring = kInnermost; ring < 1 / std::sqrt(kRingRatio); ring *= kRingRatio) rings.push_back(ring);
  rings.push_back(1);

  Surface surface;
  surface.add_grid(rings.size(), rays.size(), [&](std::size_t row, std::size_t column) {
    const double ring = rings[rings.size() - 1 - row];  // inwards, so that the outside faces out
    const V2 ray = rays[column] * (0.5 * ring);
    return vertex_at(cap_normal(0.5 + ray.x, 0.5 + ray.y), ring);
  });
  return {{std::move(surface), {.name = "apex", .roughness = 0.75, .vertex_colors = true}}};
}

std::vector<Part> apex_atoms() {
  constexpr std::int64_t kRows = 42, kColumns = 50;
  Surface surface;
  for (std::int64_t row = -kRows; row <= kRows; ++row) {
    for (std::int64_t column = -kColumns; column <= kColumns; ++column) {
      const double shift = row % 2 != 0 ? 0.5 : 0.0;
      const V2 at = V2{static_cast<double>(column) + shift + 0.25 * (random_unit(column, row, 81) - 0.5),
                       static_cast<double>(row) * std::sqrt(0.75) + 0.25 * (random_unit(column, row, 82) - 0.5)} *
                    kSpacing;
      const double depth = sunk(at, column, row);
      if (depth > 2 * kShell) continue;
      const bool nitrogen = random_unit(column, row, 83) > 0.45;
      const double radius = nitrogen ? 0.85 * kRadius : kRadius;
      const V3 center = V3{0, 0, kShell + tip_radius()} + normal_at(at) * (tip_radius() + kShell - depth - radius);
      const bool below = dot(at, at) < kSeenFromBelow * kSeenFromBelow;
      const int fine = below || (at.y < 0 && std::abs(at.x) < kNearAside) ? 2 : 1;
      add_atom(surface, center, radius, Facing::Down, nitrogen ? kNitrogen : kSilicon,
               {.around = fine, .rings = dot(at, at) < kNearest * kNearest ? 3 : fine});
    }
  }
  return {{std::move(surface), {.name = "tip atoms", .roughness = 0.35, .vertex_colors = true}}};
}

}  // namespace afm::generate
