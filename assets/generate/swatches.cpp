// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "models.h"

namespace afm::generate {
namespace {

constexpr double kCm = 0.01;
constexpr double kOutline = 0.17 * kCm;

// The plinth, seen from its right side (z to the viewer): a block whose front leans back under the label.
constexpr double kWidth = 30 * kCm, kDepth = 22 * kCm, kPlinthHeight = 8 * kCm;
constexpr V2 kFrontLow{11 * kCm, 1.8 * kCm};               // coordinates z, y
constexpr V2 kFrontHigh{5.5 * kCm, kPlinthHeight};         // coordinates z, y
constexpr double kTopMiddle = (5.5 * kCm - 11 * kCm) / 2;  // z of the middle of the top

MaterialSpec plinth_material() { return {.name = "plinth", .base_color = {0.060, 0.065, 0.075}, .roughness = 0.42}; }

// Local z runs along the room's x; local (x, y) are the room's (z, y), which turns the outline's sense.
Surface plinth() {
  const double edge = 0.6 * kCm;
  const double back = -kDepth / 2;
  const std::vector<V2> side{{back, 0}, {kFrontLow.x, 0}, kFrontLow, kFrontHigh, {back, kPlinthHeight}};
  Surface prism, placed;
  add_prism(prism, rounded_polygon(side, edge, 2), -kWidth / 2, kWidth / 2, edge * 0.8);
  add_placed(placed, prism, {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}});
  return placed;
}

// Local z becomes the room's up, standing at (x, height, z).
Placement upright(double x, double height, double z) { return {{x, height, z}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}}; }

// The middle of the slanted face: x to the right, y up along the slope, z outwards.
NodeSpec label() {
  const V2 along = unit(V2{kFrontHigh.x - kFrontLow.x, kFrontHigh.y - kFrontLow.y});
  const V2 middle = (kFrontLow + kFrontHigh) * 0.5;
  const V2 reach = kFrontHigh - kFrontLow;
  const Placement placement{{0, middle.y, middle.x}, {1, 0, 0}, {0, along.y, along.x}, {0, -along.x, along.y}};
  return {.name = "label",
          .parent = 0,
          .placement = placement,
          .extras = {{"width_m", kWidth - 3 * kCm}, {"height_m", std::sqrt(dot(reach, reach)) - 1.6 * kCm}}};
}

// The soft shadow of the plinth on the floor, from its foot outwards.
NodeSpec shade() {
  constexpr double kLift = 0.2 * kCm, kReach = 8 * kCm, kDarkest = 0.62;
  constexpr std::size_t kRings = 6;
  const Outline foot = rounded_rectangle({-kWidth / 2, -kDepth / 2}, {kWidth / 2, kDepth / 2}, 2 * kCm, 2);
  Surface surface;
  surface.add_grid(kRings + 1, foot.size() + 1, [&](std::size_t row, std::size_t column) {
    const double out = 1 - static_cast<double>(row) / kRings;  // 1 far from the foot
    const OutlinePoint& point = foot[column % foot.size()];
    const V2 place = point.position + point.normal * (out * kReach - 1 * kCm);
    return SurfaceVertex{{place.x, kLift, -place.y}, {0, 1, 0}, {0, 0, 0}, kDarkest * (1 - out) * (1 - out)};
  });
  return {.name = "shade",
          .parent = 0,
          .parts = {{std::move(surface),
                     {.name = "shade", .roughness = 1, .fading = true, .unlit = true, .vertex_colors = true}}}};
}

Model swatch(std::string name, Surface sample, MaterialSpec material, Surface outline) {
  Model model{std::move(name), {}};
  model.nodes.push_back({.name = "swatch",
                         .parts = {{std::move(sample), std::move(material)},
                                   {plinth(), plinth_material()},
                                   {std::move(outline), outline_material()}},
                         .extras = {{"width_m", kWidth}, {"depth_m", kDepth}, {"plinth_height_m", kPlinthHeight}}});
  model.nodes.push_back(label());
  model.nodes.push_back(shade());
  return model;
}

// All are low, so that the sample's front edge is seen above them.

// A book of mica: irregular six-sided flakes, each turned a little against the one below.
Model mica() {
  constexpr int kFlakes = 4;
  constexpr double kFlake = 0.78 * kCm, kPitch = 1.02 * kCm;
  constexpr double kHalf = 0.5;
  const double c = std::sqrt(0.75);
  const V2 hexagon[] = {{1, 0}, {kHalf, c}, {-kHalf, c}, {-1, 0}, {-kHalf, -c}, {kHalf, -c}};
  Surface stack, outline;
  for (int flake = 0; flake < kFlakes; ++flake) {
    const auto random = [&](int what) { return random_unit(flake, what, 61); };
    std::vector<V2> corners;
    corners.reserve(6);
    for (int k = 0; k < 6; ++k) corners.push_back(hexagon[k] * ((8.2 + 2.2 * random(k) - 0.35 * flake) * kCm));
    const Outline around = rounded_polygon(corners, 0.6 * kCm, 0);
    Surface prism;
    add_prism(prism, around, 0, kFlake, 0.14 * kCm);
    const double shade = flake % 2 == 0 ? 1.0 : 0.84;
    prism.paint(
        {shade * mix(0.90, 1.0, random(8)), shade * mix(0.93, 1.0, random(6)), shade * mix(0.90, 1.06, random(7))});

    // turned about the vertical and tipped by a few degrees
    const V2 turn = unit(V2{1, 0.5 * (random(8) - 0.5)});
    const V3 up = unit(V3{0.045 * (random(9) - 0.5), 1, 0.045 * (random(10) - 0.5)});
    const V3 x = unit(cross(up, {turn.y, 0, turn.x}));
    const V3 origin{1.2 * kCm * (random(11) - 0.5), kPlinthHeight + 0.1 * kCm + flake * kPitch,
                    kTopMiddle + 1.0 * kCm * (random(12) - 0.5)};
    const Placement placement{origin, x, cross(up, x), up};
    add_placed(stack, prism, placement);
    add_placed(outline, outline_of(around, 0, around, kFlake, kOutline), placement);
  }
  return swatch("swatch-mica", std::move(stack),
                {.name = "mica", .base_color = {0.68, 0.68, 0.68}, .roughness = 0.16, .vertex_colors = true},
                std::move(outline));
}

constexpr double kBarHeight = 4.4 * kCm, kBarLean = 1.3 * kCm, kBarRound = 0.6 * kCm;
constexpr V2 kBarHalf{11 * kCm, 3.6 * kCm};

Outline bar_outline(double in, int halvings) {
  const V2 half = kBarHalf - V2{in, in};
  return rounded_rectangle(half * -1.0, half, kBarRound, halvings);
}

// A bar whose sides lean in, as it comes out of the mould.
Surface ingot() {
  const double height = kBarHeight, lean = kBarLean, bevel = 0.5 * kCm;
  const Outline foot = bar_outline(0, 2), rim = bar_outline(lean, 2);
  Surface bar;
  add_loft(bar, {{inset(foot, bevel * 0.5), 0, 0, -1},
                 {foot, bevel * 0.5, height, lean},
                 {rim, height - bevel, height, lean},
                 {inset(rim, bevel), height, 0, 1}});
  add_cap(bar, inset(foot, bevel * 0.5), 0, Facing::Down);
  add_cap(bar, inset(rim, bevel), height, Facing::Up);

  // low parts get their light from the foot; gold seen in gold is redder
  for (SurfaceVertex& vertex : bar.vertices) {
    const double lit = mix(0.34, 1, smooth_step(0, 0.75 * height, vertex.position.z));
    vertex.color = {lit, lit * mix(0.8, 1, lit), lit * mix(0.6, 1, lit)};
  }
  return bar;
}

// Two bars beside each other.
Model gold() {
  Surface pile, outline;
  const Surface bar = ingot();
  const Surface around = outline_of(bar_outline(0, 0), 0, bar_outline(kBarLean, 0), kBarHeight, kOutline);
  for (const Placement& placement : {upright(0.6 * kCm, kPlinthHeight, kTopMiddle - 3.9 * kCm),
                                     upright(-0.6 * kCm, kPlinthHeight, kTopMiddle + 3.9 * kCm)}) {
    add_placed(pile, bar, placement);
    add_placed(outline, around, placement);
  }
  return swatch(
      "swatch-gold", std::move(pile),
      {.name = "gold", .base_color = {1.0, 0.72, 0.28}, .metallic = 1, .roughness = 0.24, .vertex_colors = true},
      std::move(outline));
}

void add_arc(Outline& outline, V2 center, double radius, V2 from, V2 to, int halvings) {
  for (const V2 direction : arc(from, to, halvings)) outline.push_back({center + direction * radius, direction});
}

// A circle whose lowest part is cut off at y = -flat; fillets of `fillet` join the two.
Outline disc_with_flat(double radius, double flat, double fillet, int halvings) {
  const double x = std::sqrt((radius - fillet) * (radius - fillet) - (flat - fillet) * (flat - fillet));
  const V2 right{x, fillet - flat}, left{-x, fillet - flat};
  const V2 turns[] = {unit(right), {1, 0}, {0, 1}, {-1, 0}, unit(left)};
  Outline outline;
  for (std::size_t i = 0; i + 1 < 5; ++i) add_arc(outline, {0, 0}, radius, turns[i], turns[i + 1], halvings);
  add_arc(outline, left, fillet, unit(left), {0, -1}, halvings / 2);
  add_arc(outline, right, fillet, {0, -1}, unit(right), halvings / 2);
  return outline;
}

// A polished disc with the flat that marks its orientation, nearly level on a foot.
Model silicon_nitride() {
  constexpr double kRadius = 8.4 * kCm, kFlat = 7.8 * kCm, kThickness = 1.3 * kCm;
  constexpr double kLean = 0.16, kAcross = 0.987117;  // sine and cosine
  Surface wafer, group, outline;
  add_prism(wafer, disc_with_flat(kRadius, kFlat, 1.0 * kCm, 4), -kThickness / 2, kThickness / 2, 0.25 * kCm);
  const Placement leaning{
      {0, kPlinthHeight + 0.7 * kCm + kFlat * kLean, kTopMiddle}, {1, 0, 0}, {0, kLean, -kAcross}, {0, kAcross, kLean}};
  const Outline around = disc_with_flat(kRadius, kFlat, 1.0 * kCm, 3);
  add_placed(group, wafer, leaning);
  add_placed(outline, outline_of(around, -kThickness / 2, around, kThickness / 2, kOutline), leaning);
  Surface foot;
  add_prism(foot, rounded_rectangle({-6 * kCm, -2.2 * kCm}, {6 * kCm, 2.2 * kCm}, 0.8 * kCm, 3), 0, 1.1 * kCm,
            0.3 * kCm);
  Model model =
      swatch("swatch-si3n4", std::move(group),
             {.name = "silicon nitride", .base_color = {0.085, 0.100, 0.130}, .metallic = 0.1, .roughness = 0.12},
             std::move(outline));
  Surface stand;
  add_placed(stand, foot, upright(0, kPlinthHeight, kTopMiddle - 2 * kCm));
  model.nodes.front().parts.push_back(
      {std::move(stand), {.name = "stand", .base_color = {0.45, 0.46, 0.48}, .metallic = 1, .roughness = 0.35}});
  return model;
}

}  // namespace

std::vector<Model> swatches() { return {mica(), gold(), silicon_nitride()}; }

}  // namespace afm::generate
