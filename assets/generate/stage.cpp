// SPDX-License-Identifier: Apache-2.0
#include "models.h"

namespace afm::generate {
namespace {

constexpr double kMm = 1e-3;
constexpr double kPuckRadius = 7.5 * kMm;
constexpr double kPuckHeight = 1 * kMm;
constexpr int kRound = 4;  // halvings: 64 points around

MaterialSpec steel() { return {.name = "steel", .base_color = {0.56, 0.57, 0.58}, .metallic = 1, .roughness = 0.32}; }
MaterialSpec dark() { return {.name = "piezo ceramic", .base_color = {0.10, 0.105, 0.115}, .roughness = 0.45}; }
MaterialSpec brass() {
  return {.name = "electrode", .base_color = {0.34, 0.23, 0.12}, .metallic = 0.4, .roughness = 0.45};
}

Surface puck() {
  const double r = kPuckRadius, bevel = 0.22 * kMm;
  Surface surface;
  add_lathe(
      surface,
      {{r - bevel, -kPuckHeight, 0, -1}, {r, -kPuckHeight + bevel, 1, 0}, {r, -bevel, 1, 0}, {r - bevel, 0, 0, 1}},
      kRound);
  add_cap(surface, circle(r - bevel, kRound), 0, Facing::Up);
  add_cap(surface, circle(r - bevel, kRound), -kPuckHeight, Facing::Down);
  return surface;
}

// The magnet holder and the top of the scanner tube, from the puck downwards.
Surface scanner() {
  const double top = -kPuckHeight, b = 0.2 * kMm;
  const double holder = 6.2 * kMm, tube = 5.0 * kMm, neck = -2.6 * kMm, end = -12 * kMm;
  Surface surface;
  add_lathe(surface,
            {{tube, end, 1, 0},
             {tube, neck, 1, 0},
             {tube, neck, 0, -1},
             {holder - b, neck, 0, -1},
             {holder, neck + b, 1, 0},
             {holder, top - b, 1, 0},
             {holder - b, top, 0, 1},
             {0, top, 0, 1}},
            kRound);
  return surface;
}

Surface electrode_band(double low, double high) {
  const double r = 5.0 * kMm, raised = 5.06 * kMm;
  Surface surface;
  add_lathe(surface,
            {{r, low, 0, -1},
             {raised, low, 0, -1},
             {raised, low, 1, 0},
             {raised, high, 1, 0},
             {raised, high, 0, 1},
             {r, high, 0, 1}},
            kRound);
  return surface;
}

}  // namespace

Model stage() {
  Surface bands = electrode_band(-5.2 * kMm, -4.4 * kMm);
  add_placed(bands, electrode_band(-10.8 * kMm, -6.0 * kMm), {});
  Model model{"stage", {}};
  model.nodes.push_back({.name = "scanner", .placement = kYUpFromZUp});
  model.nodes.push_back({.name = "stage",
                         .parent = 0,
                         .parts = {{puck(), steel()}, {scanner(), dark()}, {std::move(bands), brass()}},
                         .extras = {{"puck_diameter_m", 2 * kPuckRadius}, {"puck_height_m", kPuckHeight}}});
  return model;
}

}  // namespace afm::generate
