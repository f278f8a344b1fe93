// SPDX-License-Identifier: Apache-2.0
#include "journey_apex.h"
#include "models.h"
#include "probe_parts.h"

namespace afm::generate {
namespace {

constexpr double kMm = 1e-3, kUm = 1e-6, kNm = 1e-9;

// The tip rests this far above the sample.
constexpr double kGap = 0.6 * kNm;

MaterialSpec wood() { return {.name = "bench", .base_color = {0.19, 0.115, 0.065}, .roughness = 0.42}; }
MaterialSpec granite() { return {.name = "granite", .base_color = {0.045, 0.047, 0.052}, .roughness = 0.22}; }
MaterialSpec housing() { return {.name = "housing", .base_color = {0.66, 0.68, 0.70}, .roughness = 0.33}; }
MaterialSpec anodised() {
  return {.name = "anodised", .base_color = {0.07, 0.10, 0.16}, .metallic = 0.85, .roughness = 0.34};
}
MaterialSpec steel() { return {.name = "steel", .base_color = {0.62, 0.63, 0.64}, .metallic = 1, .roughness = 0.26}; }
MaterialSpec brass() { return {.name = "brass", .base_color = {0.83, 0.62, 0.28}, .metallic = 1, .roughness = 0.25}; }
MaterialSpec glass() {
  return {.name = "lens", .base_color = {0.06, 0.10, 0.20}, .roughness = 0.05, .emissive = {0.16, 0.01, 0.01}};
}
MaterialSpec silicon() {
  return {.name = "silicon", .base_color = {0.30, 0.32, 0.37}, .metallic = 0.85, .roughness = 0.30};
}
MaterialSpec nitride() { return {.name = "silicon nitride", .base_color = {0.62, 0.40, 0.13}, .roughness = 0.24}; }
MaterialSpec ceramic() { return {.name = "probe holder", .base_color = {0.50, 0.44, 0.36}, .roughness = 0.40}; }

Surface block(V3 low, V3 high, double round, double bevel) {
  Surface surface;
  add_prism(surface, rounded_rectangle({low.x, low.y}, {high.x, high.y}, round, 3), low.z, high.z, bevel);
  return surface;
}

Surface rod(double radius, double low, double high, double bevel, int halvings = 3) {
  Surface surface;
  add_prism(surface, circle(radius, halvings), low, high, bevel);
  return surface;
}

std::vector<Part> bench() {
  return {
      {block({-800 * kMm, -300 * kMm, -190 * kMm}, {800 * kMm, 560 * kMm, -160 * kMm}, 30 * kMm, 4 * kMm), wood()},
      {block({-170 * kMm, -150 * kMm, -159 * kMm}, {170 * kMm, 190 * kMm, -121 * kMm}, 14 * kMm, 4 * kMm), granite()}};
}

// A desktop instrument: base and column behind, a head that reaches over the stage, open to the front.
std::vector<Part> instrument() {
  Surface shell = block({-80 * kMm, -70 * kMm, -120 * kMm}, {80 * kMm, 120 * kMm, -62 * kMm}, 22 * kMm, 7 * kMm);
  add_placed(shell, block({-52 * kMm, 52 * kMm, -64 * kMm}, {52 * kMm, 112 * kMm, 128 * kMm}, 20 * kMm, 7 * kMm), {});
  Surface head = block({-46 * kMm, -18 * kMm, 34 * kMm}, {46 * kMm, 96 * kMm, 98 * kMm}, 16 * kMm, 6 * kMm);
  add_placed(head, rod(24 * kMm, 96 * kMm, 150 * kMm, 3 * kMm), {{0, 18 * kMm, 0}});

  Surface metal = rod(13 * kMm, -64 * kMm, -9 * kMm, 0.8 * kMm, 4);  // the scanner and its stage
  add_placed(metal, rod(17 * kMm, -9.5 * kMm, -2.4 * kMm, 0.5 * kMm, 5), {});
  add_placed(metal, rod(15 * kMm, 150 * kMm, 188 * kMm, 1.5 * kMm), {{0, 18 * kMm, 0}});
  Surface trim;
  for (const double x : {47 * kMm, -59 * kMm}) {  // positions of the focus knobs
    add_placed(trim, rod(15 * kMm, 0, 12 * kMm, 1.5 * kMm), {{x, 66 * kMm, 62 * kMm}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}});
  }
  add_placed(trim, rod(24.6 * kMm, 112 * kMm, 120 * kMm, 0.8 * kMm), {{0, 18 * kMm, 0}});
  Surface puck = rod(7.5 * kMm, -1.4 * kMm, -0.36 * kMm, 0.15 * kMm, 5);

  // the objective that looks down on the lever, its lens above the holder
  Surface barrel = rod(8 * kMm, 26 * kMm, 36 * kMm, 1 * kMm);
  add_placed(barrel, rod(5.5 * kMm, 21 * kMm, 26.5 * kMm, 0.8 * kMm), {});
  Surface lens = rod(4.2 * kMm, 20.7 * kMm, 21.2 * kMm, 0.2 * kMm);
  return {{std::move(shell), housing()}, {std::move(head), anodised()},   {std::move(metal), steel()},
          {std::move(puck), steel()},    {std::move(barrel), anodised()}, {std::move(lens), glass()},
          {std::move(trim), brass()}};
}

// The lever comes from behind, a little from the left, and leans towards the sample by some eleven degrees.
Placement lever_placement() {
  const V3 along = unit(V3{0.40, -0.89, -0.19});
  const V3 across = unit(cross({0, 0, 1}, along));
  const V3 up = cross(along, across);
  const V3 end{0, 0, kGap + atom_shell() + tip_length() - 0.5 * kUm};  // the tip's base reaches into the lever
  return {end - along * lever_tip_x(), along, across, up};
}

std::vector<Part> placed(const std::vector<Part>& parts, const Placement& placement) {
  std::vector<Part> result;
  for (const Part& part : parts) {
    result.push_back({{}, part.material});
    add_placed(result.back().surface, part.surface, placement);
  }
  return result;
}

// 3.4 mm x 1.6 mm x 0.3 mm as chips are sold, with the flanks of a {111} etch; and the holder that grips it.
std::vector<Part> chip() {
  const double slope = 300 * kUm / std::sqrt(2.0), round = 40 * kUm, bevel = 12 * kUm;
  const double low = lever_thickness(), high = low + 300 * kUm;
  const V2 foot_low{-3400 * kUm, -800 * kUm}, foot_high{0, 800 * kUm};
  const Outline foot = rounded_rectangle(foot_low, foot_high, round, 3);
  const Outline edge = rounded_rectangle(foot_low + V2{slope, slope}, foot_high - V2{slope, slope}, round, 3);
  Surface body, film;
  add_loft(body,
           {{foot, low, std::sqrt(2.0), 1}, {edge, high - bevel, std::sqrt(2.0), 1}, {inset(edge, bevel), high, 0, 1}});
  add_cap(body, inset(edge, bevel), high, Facing::Up);
  add_prism(film, foot, 0, low, 0.5 * kUm);
  return placed({{std::move(body), silicon()}, {std::move(film), nitride()}}, lever_placement());
}

std::vector<Part> holder() {
  Surface body, clip;
  add_prism(body, rounded_rectangle({-16 * kMm, -6 * kMm}, {-1.5 * kMm, 6 * kMm}, 1.2 * kMm, 3), 0.34 * kMm, 5 * kMm,
            0.3 * kMm);
  add_placed(body, block({-13 * kMm, -5 * kMm, 4.6 * kMm}, {-4 * kMm, 5 * kMm, 36 * kMm}, 2 * kMm, 0.4 * kMm), {});
  add_prism(clip, rounded_rectangle({-3.2 * kMm, -0.5 * kMm}, {-1.0 * kMm, 0.5 * kMm}, 0.2 * kMm, 2), 0.31 * kMm,
            0.46 * kMm, 0.05 * kMm);
  add_prism(clip, circle(0.9 * kMm, 4), 4.9 * kMm, 5.4 * kMm, 0.1 * kMm);
  return placed({{std::move(body), ceramic()}, {std::move(clip), steel()}}, lever_placement());
}

}  // namespace

Model journey() {
  Model model{"journey", {}};
  const Placement above{{0, 0, kGap + atom_shell()}};
  model.nodes.push_back({.name = "journey", .placement = kYUpFromZUp});
  const auto add = [&](const char* name, std::vector<Part> parts) {
    model.nodes.push_back({.name = name, .parent = 0, .parts = std::move(parts)});
  };
  add("bench", bench());
  add("instrument", instrument());
  add("holder", holder());
  add("chip", chip());
  add("lever", placed(cantilever(), lever_placement()));
  add("tip", placed({{tip_sides(apex_shares()), nitride()}}, above));
  add("apex", placed(apex(), above));
  add("tip-atoms", placed(apex_atoms(), {{0, 0, kGap}}));
  return model;
}

}  // namespace afm::generate
