// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "haptics/contact_model.h"
#include "haptics/law_family.h"
#include "scene/shared/shared_blocks.h"

namespace afm::test {

// A rubber under a tip of 30 nm.
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

// A map of 1 to 8 MPa and 20 to 80 mJ/m2 with a hill of each, as wide in the hand as a sample on the wall: 82 mm.
inline std::unique_ptr<scene::SharedLawMap> hilly_map(const scene::SharedContact& material) {
  constexpr double kWidthOfStroke = 1.65;
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
  const auto family = haptics::LawFamily::create(material, *map).value();
  const auto fit = haptics::Scaling::fit(family->laws(), haptics::omni_like("hand")).value();
  map->spacing_m = kWidthOfStroke * haptics::Scaling::kStrokeM / fit.hand_m_per_m() / 63.0;
  return map;
}

}  // namespace afm::test
