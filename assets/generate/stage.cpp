// SPDX-License-Identifier: Apache-2.0
#include "models.h"

namespace afm::generate {
namespace {

constexpr double kMm = 1e-3;
constexpr V2 kPlateHalf{8.0 * kMm, 6.6 * kMm};
constexpr double kPlateHeight = 0.30 * kMm;
constexpr int kRound = 3;  // number of halvings: 32 points around

MaterialSpec steel() { return {.name = "steel", .base_color = {0.56, 0.57, 0.58}, .metallic = 1, .roughness = 0.32}; }
MaterialSpec anodised() {
  return {.name = "anodised", .base_color = {0.055, 0.060, 0.072}, .metallic = 0.5, .roughness = 0.36};
}

// A thin plate, so that attention stays on the sample. Its top is in the sample's shade.
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

// The body under the plate, from its foot at -1 to 0: as long as the room asks for. Towards its foot it dissolves in
// the shade on the floor.
Surface body() {
  const double in = 0.75 * kMm;
  const V2 half = kPlateHalf - V2{in, in};
  const Outline outline = rounded_rectangle(half * -1.0, half, 0.5 * kMm, kRound);
  constexpr std::size_t kBands = 8;
  constexpr double kEnd = 0.62;  // lowest visible height
  Surface surface;
  surface.add_grid(kBands + 1, outline.size() + 1, [&](std::size_t row, std::size_t column) {
    const OutlinePoint& point = outline[column % outline.size()];
    const double down = kEnd * (1 - static_cast<double>(row) / kBands);
    const double lit = mix(1, 0.4, smooth_step(0, 0.4, down));
    return SurfaceVertex{{point.position.x, point.position.y, -down},
                         {point.normal.x, point.normal.y, 0},
                         {lit, lit, lit},
                         1 - smooth_step(0.02, kEnd, down)};
  });
  return surface;
}

}  // namespace

Model stage() {
  MaterialSpec shaded = anodised();
  shaded.vertex_colors = true;
  // material that no light reaches
  const MaterialSpec dissolving{.name = "dissolving",
                                .base_color = {0.016, 0.018, 0.023},
                                .roughness = 1,
                                .fading = true,
                                .unlit = true,
                                .vertex_colors = true};
  Model model{"stage", {}};
  model.nodes.push_back({.name = "stand", .placement = kYUpFromZUp});
  model.nodes.push_back({.name = "stage",
                         .parent = 0,
                         .parts = {{plate(), shaded}, {trim(), steel()}},
                         .extras = {{"plate_width_m", 2 * kPlateHalf.x}, {"plate_depth_m", 2 * kPlateHalf.y}}});
  model.nodes.push_back({.name = "body", .parent = 0, .parts = {{body(), dissolving}}});
  return model;
}

}  // namespace afm::generate
