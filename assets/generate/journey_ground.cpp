// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>

#include "grains.h"
#include "models.h"
#include "probe_parts.h"

namespace afm::generate {
namespace {

constexpr double kNm = 1e-9;
constexpr double kDiscRadius = 5e-3, kDiscThickness = 0.36e-3;
constexpr double kInnermost = 0.4 * kNm;
constexpr double kRingRatio = 1.07;  // ratio for cells about as long as wide in front of the tip
constexpr int kHalvings = 6;         // 256 directions, of which half are used in front of the tip
constexpr double kFinest = 2 * 3.14159265358979 / 256;
constexpr double kAtomsReach = 11.5 * kNm, kAtomsSink = 8.0 * kNm;  // from there outwards fewer and fewer are seen
constexpr double kNearReach = 5.0 * kNm;                            // round and outlined atoms
constexpr double kBelowAtoms = 0.2 * kNm;                           // depth of the ground below the atoms
constexpr double kCloseFrom = 7 * kNm, kCloseTo = 45 * kNm;  // from there inwards the ground has its atoms' colour
constexpr std::int64_t kAtomRows = 52, kAtomColumns = 74;    // enough for the reach

// Sides of the mesh's cell at a place, in units of the scale.
struct Cell {
  V2 outwards, across;

  // Change of a quantity with this gradient from one vertex to the next: whatever changes faster has saw teeth.
  double change(V2 gradient) const { return std::abs(dot(gradient, outwards)) + std::abs(dot(gradient, across)); }
};

// Visible features at a decade of scale.
struct Features {
  double amplitude;                          // height in units of the scale
  double (*pattern)(V2 at, const Cell& of);  // value 0..1 at a position in units of the scale
};

constexpr std::size_t kDecades = 7;  // from 1 mm to 1 nm

// Appearance of a sample from a millimetre to its atoms: every decade shows different features.
struct Look {
  const char* name;
  MaterialSpec material;
  Features decades[kDecades];
  std::function<V3(double)> tint;          // colour for a height 0..1 in the pattern
  std::function<V3(double)> close_tint{};  // mean colour of the atoms, for scales at which single ones nearly show
};

struct Place {
  double height = 0;
  double shade = 0;  // mean height in the visible patterns, 0..1
};

// Angle between two directions of the mesh, in steps of the finest: small before the tip, where the viewer is.
double every(double y) { return y < -0.7 ? 2 : y < 0.3 ? 4 : 8; }

// The patterns of the scales that are near the place's distance from the contact, faded into each other.
Place ground_at(const Look& look, double x, double y) {
  const double r = std::sqrt(x * x + y * y);
  const double bare = smooth_step(0.8 * kAtomsReach, 2 * kAtomsReach, r);  // level ground below the atoms
  const V2 out = V2{x, y} * (1 / std::max(r, 1e-12));
  const double wide = 0.5 * (every(out.y - 0.1) + every(out.y + 0.1)) * kFinest;
  double sum = 0, weights = 1e-12, height = 0;
  double scale = 1e-3;
  for (std::size_t i = 0; i < 2 * kDecades; ++i, scale *= 0.31622776601683794) {
    const Features& features = look.decades[i / 2];
    const double ratio = r / scale;
    const double weight = smooth_step(0.35, 1.1, ratio) * (1 - smooth_step(1.8, 4.5, ratio));
    if (weight <= 0) continue;
    const double turn = i % 2 == 0 ? 1.0 : -1.0;  // no two scales show the same
    const auto shift = static_cast<double>(i);
    const Cell cell{V2{turn * out.x, out.y} * (ratio * (kRingRatio - 1)), V2{-turn * out.y, out.x} * (ratio * wide)};
    const double n = features.pattern({turn * x / scale + 7.3 * shift, y / scale - 3.1 * shift}, cell);
    height -= weight * features.amplitude * scale * (1 - n) * bare;
    sum += weight * n;
    weights += weight;
  }
  const double hollow = kBelowAtoms * (1 - smooth_step(0.7 * kAtomsSink, kAtomsReach, r));
  return {height - hollow, sum / weights};
}

// Directions around the contact: close together towards the viewer, at negative y, and far apart behind.
Outline seen_around() {
  const Outline whole = circle(1, kHalvings);
  Outline around;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (i % static_cast<std::size_t>(every(whole[i].position.y)) == 0) around.push_back(whole[i]);
  }
  return around;
}

// Rings whose radii grow by a constant ratio, so that all scales are drawn alike; split where the float's steps, which
// are those of the largest radius, would show.
std::vector<Surface> rings(const Look& look) {
  const Outline around = seen_around();
  std::vector<double> radii{0};
  for (double r = kInnermost; r < kDiscRadius * 0.985; r *= kRingRatio) radii.push_back(r);
  radii.push_back(kDiscRadius);

  std::vector<std::size_t> cuts{0};
  for (std::size_t i = 1; i < radii.size(); ++i) {
    if (radii[i] > 150 * radii[cuts.back() == 0 ? 1 : cuts.back()]) cuts.push_back(i);
  }
  cuts.push_back(radii.size() - 1);

  const auto vertex = [&](std::size_t ring, std::size_t column) {
    const V2 direction = around[column % around.size()].position;
    const double r = radii[ring], step = std::max(0.025 * r, 0.1 * kInnermost);
    const double x = r * direction.x, y = r * direction.y;
    const Place here = ground_at(look, x, y);
    const double slope_x = (ground_at(look, x + step, y).height - ground_at(look, x - step, y).height) / (2 * step);
    const double slope_y = (ground_at(look, x, y + step).height - ground_at(look, x, y - step).height) / (2 * step);
    V3 color = look.tint(here.shade);
    if (look.close_tint) color = mix(look.close_tint(here.shade), color, smooth_step(kCloseFrom, kCloseTo, r));
    return SurfaceVertex{{x, y, here.height}, unit(V3{-slope_x, -slope_y, 1}), color};
  };
  std::vector<Surface> result;
  for (std::size_t part = 0; part + 1 < cuts.size(); ++part) {
    Surface surface;
    const std::size_t first = cuts[part], count = cuts[part + 1] - first + 1;
    // rows outwards from the far to the near ring, so that the upper side faces up
    const auto at = [&](std::size_t row, std::size_t column) { return vertex(first + count - 1 - row, column); };
    surface.add_grid(count, around.size() + 1, at, Cut::Level);
    result.push_back(std::move(surface));
  }

  // the disc's rim
  add_lathe(result.back(), {{kDiscRadius, -kDiscThickness, 1, 0}, {kDiscRadius, -0.02 * kDiscRadius, 1, 0}}, kHalvings);
  return result;
}

// The viewer is at negative y, 2.3 nm from the contact at S = 9 and farther away before. An atom looks largest when it
// leaves the picture: at the lower border, at 0.52 of the viewer's distance from the contact, or at a side.
Roundness roundness_at(double x, double y) {
  constexpr double kLastNm = 2.3, kLowerBorderNm = 1.2, kSide = 0.95;  // tangent of half the picture's angle
  x /= kNm;
  y /= kNm;
  const double viewer = std::max({kLastNm, -kLastNm * y / kLowerBorderNm, std::abs(x) / kSide - y});
  const double away = std::sqrt(x * x + (y + viewer) * (y + viewer));
  const auto halvings = [away](double most, double more, double some) {
    return away < most ? 3 : away < more ? 2 : away < some ? 1 : 0;
  };
  const int least = x * x + y * y < kNearReach * kNearReach / (kNm * kNm) ? 1 : 0;  // an outline shows a square
  return {.around = std::max(least, halvings(1.4, 5.2, 6.0)), .rings = std::max(1, halvings(2.4, 6.0, 6.0))};
}

// Depth of an atom below its place: the farther from the contact, the fewer are out of the ground, and the lattice
// has no edge.
double sunk(double r, std::int64_t column, std::int64_t row) {
  const double until = mix(kAtomsSink, kAtomsReach, random_unit(column, row, 96));
  return 1.7 * kBelowAtoms * smooth_step(-0.4 * kNm, 0.3 * kNm, r - until);
}

// Atoms that are seen from near, and all others.
struct Atoms {
  Surface near, far;

  Surface& at(double r) { return r < kNearReach ? near : far; }
};

Atoms mica_atoms() {
  // basal oxygens in rings of six: a triangular lattice of 0.26 nm without every fourth site, over every other of which
  // a potassium ion is left by the cleavage (W. L. Bragg's structure; a = 0.52 nm)
  constexpr double kSpacing = 0.26 * kNm;
  Atoms atoms;
  for (std::int64_t row = -kAtomRows; row <= kAtomRows; ++row) {
    for (std::int64_t column = -kAtomColumns; column <= kAtomColumns; ++column) {
      const double x = (static_cast<double>(column) + 0.5 * static_cast<double>(row)) * kSpacing;
      const double y = static_cast<double>(row) * std::sqrt(0.75) * kSpacing;
      const double r = std::sqrt(x * x + y * y);
      if (r > kAtomsReach) continue;
      const bool hole = (column % 2 != 0) && (row % 2 != 0);
      if (!hole) {
        add_atom(atoms.at(r), {x, y, -0.15 * kNm - sunk(r, column, row)}, 0.15 * kNm, Facing::Up, {0.72, 0.20, 0.15},
                 roundness_at(x, y));
      } else if (random_unit(column, row, 91) > 0.5) {
        add_atom(atoms.at(r), {x, y, -0.13 * kNm - sunk(r, column, row)}, 0.19 * kNm, Facing::Up, {0.42, 0.22, 0.62},
                 roundness_at(x, y));
      }
    }
  }
  return atoms;
}

// A triangular lattice, each atom moved by up to `disorder` of the spacing.
Atoms packed_atoms(double spacing, double disorder, const std::function<V3(double)>& color) {
  Atoms atoms;
  for (std::int64_t row = -kAtomRows; row <= kAtomRows; ++row) {
    for (std::int64_t column = -kAtomColumns; column <= kAtomColumns; ++column) {
      const double jitter_x = disorder * (random_unit(column, row, 92) - 0.5);
      const double jitter_y = disorder * (random_unit(column, row, 93) - 0.5);
      const double x = (static_cast<double>(column) + 0.5 * static_cast<double>(row) + jitter_x) * spacing;
      const double y = (static_cast<double>(row) * std::sqrt(0.75) + jitter_y) * spacing;
      const double r = std::sqrt(x * x + y * y);
      if (r > kAtomsReach) continue;
      const double radius = 0.54 * spacing;
      const double sink = disorder * 0.2 * spacing * random_unit(column, row, 94) + sunk(r, column, row);
      add_atom(atoms.at(r), {x, y, -radius - sink}, radius, Facing::Up, color(random_unit(column, row, 95)),
               roundness_at(x, y));
    }
  }
  return atoms;
}

Model ground(const Look& look, Atoms atoms) {
  Model model{std::string("ground-") + look.name, {}};
  model.nodes.push_back({.name = "ground", .placement = kYUpFromZUp});
  std::vector<Surface> parts = rings(look);
  const char* names[] = {"ring-0", "ring-1", "ring-2", "ring-3"};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    model.nodes.push_back({.name = names[i], .parent = 0, .parts = {{std::move(parts[i]), look.material}}});
  }
  MaterialSpec ball = look.material;
  ball.name = "atoms";
  ball.base_color = {1, 1, 1};
  ball.roughness = 0.35;
  model.nodes.push_back({.name = "atoms", .parent = 0, .parts = {{std::move(atoms.near), ball}}});
  model.nodes.push_back({.name = "far-atoms", .parent = 0, .parts = {{std::move(atoms.far), ball}}});
  return model;
}

// Share of a step's rise passed at `part` of the way from one to the next, where the mesh's cells change that by
// `change`: steep, but no steeper than two of them can show.
double risen(double part, double steep, double change) {
  const double half = std::clamp(0.9 * change, steep, 0.48);
  return smooth_step(0.5 - half, 0.5 + half, part);
}

double terraces(V2 at, const Cell& cell) {
  // straight steps that wander, three to two units
  constexpr V2 kAlong{1.5 * 0.37, 1.5 * 0.93};
  const double along = dot(kAlong, at) + 0.7 * noise(0.9 * at.x, 0.9 * at.y, 12);
  const double layer = std::floor(along), part = along - layer;
  const double wander = random_unit(static_cast<std::int64_t>(layer), 0, 13);
  const double next = random_unit(static_cast<std::int64_t>(layer) + 1, 0, 13);
  return mix(wander, next, risen(part, 0.12, cell.change(kAlong)));
}

double grains(V2 at, const Cell&) {
  const Grains shape{.cell = 0.62, .smallest = 0.5, .radius_low = 0.62, .radius_high = 0.9, .seed = 23};
  return shape.height(at.x, at.y);
}

double speckle(V2 at, const Cell&) {
  const Grains shape{.cell = 0.45, .smallest = 0.3, .radius_low = 0.7, .radius_high = 1.05, .seed = 43};
  return 0.75 * shape.height(at.x, at.y) + 0.125 * (1 + noise(0.8 * at.x, 0.8 * at.y, 53));
}

// A few long grooves of a polish, in two directions.
double scratches(V2 at, const Cell& cell) {
  constexpr double kHalfWidth = 0.28, kPitch = 1.3, kLength = 7;
  double depth = 0;
  for (int family = 0; family < 2; ++family) {
    const V2 along = family == 0 ? V2{0.96, 0.28} : V2{-0.6, 0.8}, across{-along.y, along.x};
    const double u = dot(along, at), v = dot(across, at);
    const double half_width = std::max(kHalfWidth, 1.8 * cell.change(across));
    const auto lane = static_cast<std::int64_t>(std::floor(v / kPitch));
    for (std::int64_t k = lane - 1; k <= lane + 1; ++k) {
      const double part = u / kLength + random_unit(k, family, 71), piece = std::floor(part);
      const auto number = static_cast<std::int64_t>(piece);
      if (random_unit(k, number, 72 + static_cast<std::uint32_t>(family)) < 0.45) continue;
      const double middle = (static_cast<double>(k) + 0.2 + 0.6 * random_unit(k, number, 74)) * kPitch;
      const double ends = smooth_step(0, 0.12, part - piece) * (1 - smooth_step(0.88, 1, part - piece));
      depth = std::max(depth, ends * (1 - smooth_step(0, half_width, std::abs(v - middle))));
    }
  }
  return 1 - 0.75 * depth - 0.12 * (1 - noise(0.4 * at.x, 0.4 * at.y, 75)) * 0.5;
}

// Round hillocks, few and of many sizes, on a level film.
double hillocks(V2 at, const Cell& cell) {
  const Grains shape{.cell = 1.1, .smallest = 0.05, .radius_low = 0.25, .radius_high = 0.55, .seed = 63};
  constexpr double kSteepness = 3 / (1.1 * 0.4);  // at the foot of a mean one, so high a foot is rounded as cells show
  const double height = shape.height(at.x, at.y);
  const double foot = std::min(0.9, kSteepness * 0.5 * (cell.change({1, 0}) + cell.change({0, 1})));
  return 0.35 + 0.65 * height * smooth_step(0, std::max(foot, 1e-3), height);
}

// Terraces one above the other, with steps that wander little.
double steps(V2 at, const Cell& cell) {
  constexpr V2 kAlong{-0.8 * 0.9, 0.8 * 0.45};
  const double along = dot(kAlong, at) + 0.35 * noise(0.5 * at.x, 0.5 * at.y, 17);
  const double layer = std::floor(along), part = along - layer;
  const auto height = [](double of) { return 0.25 * (of - 4 * std::floor(of / 4)); };
  return mix(height(layer), height(layer + 1), risen(part, 0.06, cell.change(kAlong)));
}

}  // namespace

std::vector<Model> grounds() {
  const Look mica{
      .name = "mica",
      .material = {.name = "mica", .base_color = {0.66, 0.63, 0.59}, .roughness = 0.24, .vertex_colors = true},
      .decades = {{0.020, terraces},
                  {0.014, scratches},
                  {0.024, steps},
                  {0.020, terraces},
                  {0.014, steps},
                  {0.035, steps},
                  {0, terraces}},
      .tint = [](double n) { return mix(V3{0.42, 0.48, 0.54}, V3{1.0, 0.96, 0.92}, n); },
      // oxygen and some potassium, as mica_atoms()
      .close_tint = [](double n) { return mix(V3{0.30, 0.16, 0.20}, V3{0.80, 0.42, 0.40}, n); }};
  const Look gold{.name = "gold",
                  .material = {.name = "gold",
                               .base_color = {1.0, 0.66, 0.23},
                               .metallic = 1,
                               .roughness = 0.28,
                               .vertex_colors = true},
                  .decades = {{0.03, scratches},
                              {0.035, scratches},
                              {0.05, hillocks},
                              {0.07, hillocks},
                              {0.13, grains},
                              {0.04, hillocks},
                              {0, steps}},
                  .tint = [](double n) {
                    const double lit = mix(0.42, 1, n);
                    return V3{lit, lit * mix(0.62, 1, lit), lit * mix(0.3, 1, lit)};
                  }};
  const Look nitride{.name = "si3n4",
                     .material = {.name = "silicon nitride",
                                  .base_color = {0.25, 0.25, 0.25},
                                  .roughness = 0.32,
                                  .vertex_colors = true},
                     .decades = {{0.02, scratches},
                                 {0.03, hillocks},
                                 {0.03, scratches},
                                 {0.05, hillocks},
                                 {0.05, speckle},
                                 {0.05, speckle},
                                 {0, speckle}},
                     .tint =
                         [](double n) {
                           const double lit = mix(0.5, 1, n);
                           return V3{0.240, 0.392, 0.368} * lit;
                         },
                     // silicon and nitrogen, as packed_atoms()
                     .close_tint = [](double n) { return V3{0.88, 0.90, 1.0} * mix(0.5, 1, n); }};
  std::vector<Model> models;
  models.push_back(ground(mica, mica_atoms()));
  models.push_back(ground(gold, packed_atoms(0.288 * kNm, 0, [](double) { return V3{1.0, 0.66, 0.23}; })));
  models.push_back(ground(nitride, packed_atoms(0.27 * kNm, 0.3, [](double n) {
                            return n > 0.43 ? V3{0.16, 0.28, 0.75} : V3{0.80, 0.66, 0.42};
                          })));
  return models;
}

}  // namespace afm::generate
