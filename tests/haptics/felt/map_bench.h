// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "haptics/contact_model.h"
#include "haptics/law_family.h"
#include "scene/shared/shared_blocks.h"
#include "servo_bench.h"
#include "support/deep.h"

namespace afm::test {

// Contact with a rubber under a tip of 30 nm.
inline scene::SharedContact rubber(physics::Law law) {
  scene::SharedContact material;
  material.name = scene::to_name("rubber");
  material.law = law;
  material.law_map = 1;
  material.contact.tip_radius = physics::Length(30e-9);
  material.contact.spring_constant = physics::Stiffness(0.2);
  material.contact.sample_stiffness = physics::Stiffness(HUGE_VAL);
  material.contact = haptics::contact_with(material.contact, physics::Pressure(2e6), 40e-3);
  return material;
}

// Spacing of the points of a map of the rubber that is as wide in the hand as a sample on the wall: 82 mm. The laws of
// a map take a second to compute, so this does it once per law.
inline double hilly_spacing_m(physics::Law law, const scene::SharedLawMap& map) {
  constexpr double kWidthOfStroke = 1.65;
  static std::map<physics::Law, double> known;
  if (const auto found = known.find(law); found != known.end()) return found->second;
  const auto family = haptics::LawFamily::create(rubber(law), map).value();
  const auto fit = haptics::Scaling::fit(family->laws(), haptics::omni_like("hand")).value();
  return known[law] = kWidthOfStroke * haptics::Scaling::kStrokeM / fit.hand_m_per_m() / 63.0;
}

// A map of 1 to 8 MPa and 20 to 80 mJ/m2 with a hill of each.
inline std::unique_ptr<scene::SharedLawMap> hilly_map(const scene::SharedContact& rubber) {
  auto map = std::make_unique<scene::SharedLawMap>();
  map->columns = 64;
  map->rows = 48;
  map->spacing_m = 1.0;
  for (std::uint32_t row = 0; row < map->rows; ++row) {
    for (std::uint32_t column = 0; column < map->columns; ++column) {
      const double x = column / 63.0, y = row / 47.0;
      const double stiff = 0.5 + 0.5 * std::cos(M_PI * x) * std::cos(M_PI * y);
      const double sticky = 0.5 - 0.5 * std::cos(M_PI * y);
      const std::size_t cell = row * map->columns + column;
      map->ln_modulus[cell] = static_cast<float>(std::log(1e6) + stiff * std::log(8.0));
      map->adhesion_j_per_m2[cell] = static_cast<float>(20e-3 + 60e-3 * sticky);
    }
  }
  map->spacing_m = hilly_spacing_m(rubber.law, *map);
  return map;
}

// Duration of a tick over a map.
inline constexpr double kMapTickS = 1e-3;

// Model of hilly_map() of the same rubber.
inline std::unique_ptr<haptics::ContactModel> hilly_model(const scene::SharedContact& rubber,
                                                          const haptics::DeviceSpec& device) {
  const auto map = hilly_map(rubber);
  const auto tables = required(haptics::build_tables(rubber, {}));
  const auto common = required(haptics::Scaling::common_scale(std::vector{tables}, device));
  auto model = required(haptics::ContactModel::create(rubber, 0, tables, {}, common, device, 1'000'000, map.get()));
  model->use(scene::ScaleMode::Fit);
  return model;
}

// Lifts the tip so that it is free.
inline void lift(haptics::ContactModel& model) {
  model.wait_for_lift();
  model.step({0.0, 0.0, 0.07}, {.elapsed_s = kMapTickS});
}

// Largest energy stored by the law on the way down in the middle of the map.
inline double largest_j(haptics::ContactModel& model) {
  lift(model);
  double largest = 0.0;
  for (double height_m = 0.07; height_m > -0.02; height_m -= 1e-3) {
    largest = std::max(largest, model.energy(model.step({0.0, 0.0, height_m}, {.elapsed_s = kMapTickS})).stored_j);
  }
  return largest;
}

// Places of the hand, tick by tick, straight from corner to corner of a triangle, at rest at each corner.
template <class Place>
void go_round(const std::array<glm::dvec3, 3>& corners, double mean_m_per_s, const Place& place) {
  for (std::size_t leg = 0; leg < corners.size(); ++leg) {
    const glm::dvec3 &from = corners[leg], &to = corners[(leg + 1) % corners.size()];
    const double ticks = std::ceil(glm::distance(from, to) / mean_m_per_s / kMapTickS);
    for (double tick = 1.0; tick <= ticks; tick += 1.0) {
      const double t = tick / ticks;
      place(from + t * t * (3.0 - 2.0 * t) * (to - from));
    }
  }
}

struct TakenEnergy {
  double most_j = -HUGE_VAL;  // largest work on one path
  double sum_j = 0.0;
};

// Work on a hand that moves around small triangles, drawn at random over the map up to `highest_m`; `work_j` takes the
// corners and the mean speed.
template <class Work>
TakenEnergy ten_thousand_paths(double highest_m, const Work& work_j) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> across(-0.035, 0.035), near(-0.004, 0.004), height(-0.02, highest_m),
      speed(0.02, 0.25);
  TakenEnergy taken;
  for (int path = 0; path < support::draws(10'000); ++path) {
    const glm::dvec3 middle{across(random), across(random), height(random)};
    const auto corner = [&] { return middle + glm::dvec3{near(random), near(random), near(random)}; };
    const glm::dvec3 a = corner(), b = corner(), c = corner();
    const double path_j = work_j(std::array{a, b, c}, speed(random));
    taken.most_j = std::max(taken.most_j, path_j);
    taken.sum_j += path_j;
  }
  return taken;
}

}  // namespace afm::test
