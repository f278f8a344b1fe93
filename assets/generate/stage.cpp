// SPDX-License-Identifier: Apache-2.0
#include "models.h"

namespace afm::generate {
namespace {

constexpr double kMm = 1e-3;
constexpr V2 kPlateHalf{8.0 * kMm, 6.6 * kMm};
constexpr double kPlateHeight = 0.42 * kMm;
// the post stands in the room: metres of the exhibit
constexpr double kPostRadius = 0.055, kFootRadius = 0.26;
constexpr int kRound = 3;  // halvings: 32 points around

MaterialSpec steel() { return {.name = "steel", .base_color = {0.56, 0.57, 0.58}, .metallic = 1, .roughness = 0.32}; }
MaterialSpec anodised() {
  return {.name = "anodised", .base_color = {0.055, 0.060, 0.072}, .metallic = 0.5, .roughness = 0.36};
}

// A low plate on a slim post, so that the sample is what one sees. Its top is in the sample's shade.
Surface plate() {
  constexpr double kCorner = 0.9 * kMm, kBevel = 0.09 * kMm, kSeat = 0.2;
  const auto outline = [](double in) {
    const V2 half = kPlateHalf - V2{in, in};
    return rounded_rectangle(half * -1.0, half, kCorner - in, kRound);
  };
  Surface surface;
  add_loft(surface, {{outline(kBevel), -kPlateHeight, 0, -1},
                     {outline(0), kBevel - kPlateHeight, 1, 0},
                     {outline(0), -kBevel, 1, 0},
                     {outline(kBevel), 0, 0, 1}});
  add_cap(surface, outline(kBevel), -kPlateHeight, Facing::Down);
  Surface top;
  const std::vector<Outline> rings{outline(kBevel), outline(0.3 * kMm), outline(0.55 * kMm), outline(0.85 * kMm)};
  top.add_grid(rings.size(), rings.front().size() + 1, [&](std::size_t row, std::size_t column) {
    const OutlinePoint& point = rings[row][column % rings[row].size()];
    const double lit =
        mix(1, kSeat, smooth_step(0, 1, static_cast<double>(row) / static_cast<double>(rings.size() - 1)));
    return SurfaceVertex{{point.position.x, point.position.y, 0}, {0, 0, 1}, {lit, lit, lit}};
  });
  Surface seat;
  add_cap(seat, rings.back(), 0, Facing::Up);
  seat.paint({kSeat, kSeat, kSeat});
  add_placed(surface, top, {});
  add_placed(surface, seat, {});
  return surface;
}

// A bright line under the plate's edge.
Surface trim() {
  const V2 half = kPlateHalf - V2{0.25 * kMm, 0.25 * kMm};
  Surface surface;
  add_prism(surface, rounded_rectangle(half * -1.0, half, 0.7 * kMm, kRound), -kPlateHeight - 0.16 * kMm,
            -kPlateHeight + 0.02 * kMm, 0.05 * kMm);
  return surface;
}

// From its foot at 0 to 1: as long as the room leaves it under the plate.
Surface post() {
  Surface surface;
  add_lathe(surface, {{kPostRadius, 0, 1, 0}, {kPostRadius, 1, 1, 0}}, kRound);
  return surface;
}

Surface foot() {
  Surface surface;
  add_prism(surface, circle(kFootRadius, kRound), 0, 0.030, 0.010);
  add_prism(surface, circle(1.35 * kPostRadius, kRound), 0.020, 0.075, 0.012);
  return surface;
}

}  // namespace

Model stage() {
  MaterialSpec shaded = anodised();
  shaded.vertex_colors = true;
  Model model{"stage", {}};
  model.nodes.push_back({.name = "stand", .placement = kYUpFromZUp});
  model.nodes.push_back({.name = "stage",
                         .parent = 0,
                         .parts = {{plate(), shaded}, {trim(), steel()}},
                         .extras = {{"plate_width_m", 2 * kPlateHalf.x}, {"plate_depth_m", 2 * kPlateHalf.y}}});
  model.nodes.push_back({.name = "post", .parent = 0, .parts = {{post(), steel()}}});
  model.nodes.push_back({.name = "foot", .parent = 0, .parts = {{foot(), anodised()}}});
  return model;
}

}  // namespace afm::generate
