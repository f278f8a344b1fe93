// SPDX-License-Identifier: Apache-2.0
#include "beam.h"
#include "models.h"

namespace afm::generate {
namespace {

constexpr double kCm = 0.01;
constexpr int kRound = 3;  // number of halvings: 32 points around

MaterialSpec anodised() {
  return {.name = "anodised aluminium", .base_color = {0.10, 0.11, 0.13}, .metallic = 0.9, .roughness = 0.38};
}
MaterialSpec brass() { return {.name = "brass", .base_color = {0.83, 0.62, 0.28}, .metallic = 1, .roughness = 0.25}; }
MaterialSpec glass() {
  return {.name = "lens", .base_color = {0.10, 0.16, 0.30}, .roughness = 0.04, .emissive = {0.30, 0.01, 0.01}};
}
MaterialSpec board_green() { return {.name = "circuit board", .base_color = {0.02, 0.13, 0.07}, .roughness = 0.42}; }
MaterialSpec frame_black() { return {.name = "detector frame", .base_color = {0.03, 0.03, 0.035}, .roughness = 0.35}; }
MaterialSpec sensor() {
  return {.name = "photodiode silicon", .base_color = {0.10, 0.11, 0.24}, .metallic = 0.35, .roughness = 0.16};
}

// The housing's axis is z; the light leaves at the origin towards +z.
std::vector<Part> laser() {
  std::vector<ProfilePoint> profile{
      {0, -22 * kCm, 0, -1}, {2.9 * kCm, -22 * kCm, 0, -1}, {3.2 * kCm, -21.7 * kCm, 1, 0}};
  const double fin = 3.2 * kCm, groove = 2.6 * kCm;
  for (int i = 0; i < 6; ++i) {  // cooling fins
    const double z = (-20.6 + 1.6 * i) * kCm, depth = 0.8 * kCm;
    profile.insert(profile.end(), {{fin, z, 1, 0},
                                   {fin, z, 0, 1},
                                   {groove, z, 0, 1},
                                   {groove, z, 1, 0},
                                   {groove, z + depth, 1, 0},
                                   {groove, z + depth, 0, -1},
                                   {fin, z + depth, 0, -1},
                                   {fin, z + depth, 1, 0}});
  }
  profile.insert(profile.end(),
                 {{fin, -5.3 * kCm, 1, 0}, {2.9 * kCm, -5.0 * kCm, 0, 1}, {2.4 * kCm, -5.0 * kCm, 0, 1}});
  Surface body;
  add_lathe(body, profile, kRound);

  Surface front;
  add_lathe(front,
            {{2.4 * kCm, -5.0 * kCm, 1, 0},
             {2.4 * kCm, -0.5 * kCm, 1, 0},
             {2.1 * kCm, -0.2 * kCm, 0, 1},
             {1.6 * kCm, -0.2 * kCm, 0, 1},
             {1.6 * kCm, -0.2 * kCm, -1, 0},
             {1.6 * kCm, -0.8 * kCm, -1, 0}},
            kRound);

  // a convex lens: a spherical cap through the rim whose top is the origin
  const double rim = 1.6 * kCm, depth = 0.8 * kCm;
  const double radius = (rim * rim + depth * depth) / (2 * depth);
  std::vector<ProfilePoint> cap;
  for (const V2 direction : arc({rim / radius, (radius - depth) / radius}, {0, 1}, 3)) {
    cap.push_back({direction.x * radius, direction.y * radius - radius, direction.x, direction.y});
  }
  Surface lens;
  add_lathe(lens, cap, kRound);
  return {{std::move(body), anodised()}, {std::move(front), brass()}, {std::move(lens), glass()}};
}

// A square in the board's face, its surface at z = 0, around `middle`.
Surface quadrant(V2 middle, double half) {
  Surface surface;
  const V2 reach{half, half};
  add_prism(surface, rounded_rectangle(middle - reach, middle + reach, 0.15 * kCm, 1), -0.4 * kCm, 0, 0.12 * kCm);
  return surface;
}

std::vector<Part> board() {
  Surface plate, frame, pins;
  const double half = 13 * kCm;
  add_prism(plate, rounded_rectangle({-half, -half}, {half, half}, 1.2 * kCm, 2), -2.0 * kCm, -1.0 * kCm, 0.2 * kCm);
  add_prism(frame, rounded_rectangle({-9.6 * kCm, -9.6 * kCm}, {9.6 * kCm, 9.6 * kCm}, 0.8 * kCm, 2), -1.1 * kCm,
            -0.25 * kCm, 0.2 * kCm);
  for (int side = -1; side <= 1; side += 2) {
    for (int i = 0; i < 6; ++i) {  // contacts along the left and right edges
      const V2 middle{side * 11.2 * kCm, (i - 2.5) * 3.0 * kCm};
      const V2 reach{0.7 * kCm, 0.5 * kCm};
      add_prism(pins, rounded_rectangle(middle - reach, middle + reach, 0.3 * kCm, 1), -1.1 * kCm, -0.75 * kCm,
                0.12 * kCm);
    }
  }
  return {{std::move(plate), board_green()}, {std::move(frame), frame_black()}, {std::move(pins), brass()}};
}

MaterialSpec red_light(const char* name, double alpha) {
  return {.name = name, .base_color = {1.0, 0.20, 0.12}, .alpha = alpha, .unlit = true};
}

}  // namespace

Model optics() {
  Model model{"optics", {}};
  model.nodes.push_back({.name = "laser", .parts = laser(), .extras = {{"length_m", 22 * kCm}}});
  const double half = 4.3 * kCm, middle = 4.45 * kCm;
  model.nodes.push_back(
      {.name = "photodiode", .parts = board(), .extras = {{"side_m", 26 * kCm}, {"gap_m", 2 * (middle - half)}}});
  const V2 middles[] = {{-middle, middle}, {middle, middle}, {-middle, -middle}, {middle, -middle}};
  const char* names[] = {"quadrant-a", "quadrant-b", "quadrant-c", "quadrant-d"};
  for (std::size_t i = 0; i < 4; ++i) {
    model.nodes.push_back({.name = names[i], .parent = 1, .parts = {{quadrant(middles[i], half), sensor()}}});
  }
  model.nodes.push_back(
      {.name = "beam", .parts = {{unit_beam(), red_light("beam light", 0.7)}}, .extras = mark_role()});
  Surface disc;
  add_cap(disc, circle(1, 3), 0, Facing::Up);
  model.nodes.push_back(
      {.name = "spot", .parts = {{std::move(disc), red_light("spot light", 0.95)}}, .extras = mark_role()});
  return model;
}

}  // namespace afm::generate
