// SPDX-License-Identifier: Apache-2.0
#include "beam.h"
#include "models.h"

namespace afm::generate {
namespace {

constexpr double kCm = 0.01;
constexpr int kRound = 3;  // number of halvings: 32 points around

MaterialSpec grip() { return {.name = "grip", .base_color = {0.045, 0.05, 0.06}, .roughness = 0.55}; }
MaterialSpec shell() { return {.name = "shell", .base_color = {0.75, 0.78, 0.80}, .roughness = 0.30}; }
MaterialSpec ball() {
  return {.name = "ball", .base_color = {0.05, 0.55, 0.62}, .roughness = 0.25, .emissive = {0.02, 0.30, 0.36}};
}

// Along z with the ball's front at the origin; turned by the node so that the wand points along -z.
Surface handle() {
  Surface surface;
  add_lathe(surface,
            {{0, -20 * kCm, 0, -1},
             {1.1 * kCm, -20 * kCm, 0, -1},
             {1.5 * kCm, -19.6 * kCm, 1, 0},
             {1.35 * kCm, -15 * kCm, 1, 0},
             {1.55 * kCm, -9 * kCm, 1, 0.05},
             {1.3 * kCm, -6.5 * kCm, 1, 0.2}},
            kRound);
  return surface;
}

Surface neck() {
  Surface surface;
  add_lathe(surface,
            {{1.3 * kCm, -6.5 * kCm, 0, -1},
             {1.65 * kCm, -6.5 * kCm, 0, -1},
             {1.75 * kCm, -6.4 * kCm, 1, 0},
             {1.75 * kCm, -5.9 * kCm, 1, 0},
             {1.65 * kCm, -5.8 * kCm, 0, 1},
             {0.8 * kCm, -5.6 * kCm, 0.3, 1},
             {0.7 * kCm, -4.0 * kCm, 1, 0},
             {0.7 * kCm, -3.2 * kCm, 1, 0}},
            kRound);
  return surface;
}

Surface sphere() {
  const double radius = 1.8 * kCm;
  std::vector<ProfilePoint> profile;
  std::vector<V2> directions = arc({0, -1}, {1, 0}, 3);
  const std::vector<V2> upper = arc({1, 0}, {0, 1}, 3);
  directions.insert(directions.end(), upper.begin() + 1, upper.end());
  profile.reserve(directions.size());
  for (const V2 d : directions) profile.push_back({d.x * radius, d.y * radius - radius, d.x, d.y});
  Surface surface;
  add_lathe(surface, profile, kRound);
  return surface;
}

Surface turned(const Surface& surface) {
  Surface result;
  add_placed(result, surface, {{0, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}});
  return result;
}

}  // namespace

Model wand() {
  Model model{"wand", {}};
  model.nodes.push_back(
      {.name = "wand", .parts = {{turned(handle()), grip()}, {turned(neck()), shell()}, {turned(sphere()), ball()}}});
  model.nodes.push_back(
      {.name = "ray",
       .parts = {{unit_beam(), {.name = "ray light", .base_color = {0.20, 1.0, 1.0}, .alpha = 0.75, .unlit = true}}},
       .extras = mark_role()});
  return model;
}

}  // namespace afm::generate
