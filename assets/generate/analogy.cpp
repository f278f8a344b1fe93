// SPDX-License-Identifier: Apache-2.0
#include "models.h"

namespace afm::generate {
namespace {

constexpr double kCm = 0.01;

// The spring, from z = 0 up; it is stretched along z.
constexpr double kSpringLength = 20 * kCm, kCoil = 7.5 * kCm, kWire = 1.1 * kCm;
constexpr int kTurns = 7;

// The horseshoe magnet, its poles at z = 0.
constexpr double kMagnetHeight = 17 * kCm, kBow = 7 * kCm, kLimb = 2.1 * kCm, kPole = 3.2 * kCm;

Surface spring() {
  const Outline turn = circle(1, 2), wire = circle(1, 1);
  const std::size_t sections = turn.size() * kTurns + 1;
  Surface surface;
  surface.add_grid(wire.size() + 1, sections, [&](std::size_t row, std::size_t column) {
    const V2 out = turn[column % turn.size()].position, around = wire[row % wire.size()].position;
    const double height =
        kWire + (kSpringLength - 2 * kWire) * static_cast<double>(column) / static_cast<double>(sections - 1);
    const V3 normal{out.x * around.x, out.y * around.x, around.y};
    return SurfaceVertex{V3{out.x * kCoil, out.y * kCoil, height} + normal * kWire, normal};
  });
  return surface;
}

// A square bar swept along the bow and its two limbs; `corner` of the bar's section turns with the path.
Surface horseshoe() {
  struct Step {
    V2 place, out;
  };
  std::vector<Step> path{{{kBow, kPole}, {1, 0}}};
  for (const V2 d : arc({1, 0}, {0, 1}, 3))
    path.push_back({{d.x * kBow, kMagnetHeight - kBow - kLimb + d.y * kBow}, d});
  for (const V2 d : arc({0, 1}, {-1, 0}, 3))
    path.push_back({{d.x * kBow, kMagnetHeight - kBow - kLimb + d.y * kBow}, d});
  path.push_back({{-kBow, kPole}, {-1, 0}});

  // the section's corners, counter-clockwise as seen along the path
  constexpr V2 kCorners[] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  constexpr V2 kFaces[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  Surface surface;
  for (std::size_t face = 0; face < 4; ++face) {
    surface.add_grid(2, path.size(), [&](std::size_t row, std::size_t column) {
      const Step& step = path[column];
      const V2 corner = kCorners[(face + 1 - row) % 4];
      const V2 place = step.place + step.out * (corner.x * kLimb);
      const V3 normal{step.out.x * kFaces[face].x, kFaces[face].y, step.out.y * kFaces[face].x};
      return SurfaceVertex{{place.x, corner.y * kLimb, place.y}, normal};
    });
  }
  return surface;
}

Surface poles() {
  Surface surface;
  for (const double x : {-kBow, kBow}) {
    const V2 reach{kLimb * 1.04, kLimb * 1.04};
    add_prism(surface, rounded_rectangle(V2{x, 0} - reach, V2{x, 0} + reach, 0.3 * kCm, 2), 0, kPole, 0.25 * kCm);
  }
  return surface;
}

}  // namespace

Model analogy() {
  Model model{"analogy", {}};
  Surface plate, knob;
  add_prism(plate, rounded_rectangle({-46 * kCm, -38 * kCm}, {46 * kCm, 30 * kCm}, 4 * kCm, 3), -14 * kCm, 0, 1 * kCm);
  add_prism(knob, rounded_rectangle({-15 * kCm, -4 * kCm}, {15 * kCm, 4 * kCm}, 3.6 * kCm, 3), 0, 6 * kCm, 1.6 * kCm);
  model.nodes.push_back({.name = "analogy", .placement = kYUpFromZUp});
  model.nodes.push_back(
      {.name = "plate",
       .parent = 0,
       .parts = {{std::move(plate),
                  {.name = "iron", .base_color = {0.25, 0.26, 0.28}, .metallic = 0.9, .roughness = 0.42}}}});
  model.nodes.push_back(
      {.name = "magnet",
       .parent = 0,
       .parts = {{horseshoe(), {.name = "red lacquer", .base_color = {0.62, 0.035, 0.025}, .roughness = 0.25}},
                 {poles(), {.name = "steel", .base_color = {0.62, 0.63, 0.64}, .metallic = 1, .roughness = 0.25}}},
       .extras = {{"height_m", kMagnetHeight}}});
  model.nodes.push_back(
      {.name = "spring",
       .parent = 0,
       .parts = {{spring(),
                  {.name = "spring steel", .base_color = {0.70, 0.72, 0.75}, .metallic = 1, .roughness = 0.22}}},
       .extras = {{"length_m", kSpringLength}}});
  model.nodes.push_back(
      {.name = "hand",
       .parent = 0,
       .parts = {{std::move(knob), {.name = "beech", .base_color = {0.46, 0.28, 0.13}, .roughness = 0.45}}}});
  return model;
}

}  // namespace afm::generate
