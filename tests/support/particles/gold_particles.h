// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/tip_contact.h"
#include "scene/shared/particle_blocks.h"
#include "support/paper_model.h"

// Gold spheres of 50 nm for tests that need no files, with the tip and lever of assets/particles/gold-row.toml.
namespace afm::test {

inline constexpr double kGoldRadiusM = 25e-9;

inline scene::SharedSpecies gold_species() {
  scene::SharedSpecies gold;
  gold.name = scene::to_name("gold");
  gold.radius_m = kGoldRadiusM;
  gold.reduced_modulus_pa = 38.7e9;
  gold.work_of_adhesion_j_per_m2 = 0.1;
  gold.shear_strength_pa = 10e6;
  gold.coefficient = 0.3;
  gold.kinetic_ratio = 0.5;
  gold.ageing_s = 0.1;
  gold.rolling_distance_m = 0.3e-9;
  gold.tip_adhesion_j_per_m2 = 0.02;
  return gold;
}

// A sliding sphere with the same threshold at any load.
inline scene::SharedSpecies constant_species(double threshold_n, double kinetic_ratio, double radius_m = kGoldRadiusM) {
  scene::SharedSpecies species = gold_species();
  species.radius_m = radius_m;
  species.law = physics::ParticleLaw::Measured;
  species.measured_threshold_n = threshold_n;
  species.kinetic_ratio = kinetic_ratio;
  species.rolling_distance_m = 0.0;
  species.tip_adhesion_j_per_m2 = 0.0;
  return species;
}

struct PlaceM {
  double x = 0.0, y = 0.0;
};

inline scene::SharedParticles particles_at(const std::vector<PlaceM>& places,
                                           const scene::SharedSpecies& species = gold_species()) {
  scene::SharedParticles particles;
  particles.pusher.tip_radius_m = species.radius_m < 50e-9 ? 10e-9 : 20e-9;
  particles.pusher.half_angle_rad = std::numbers::pi / 12.0;
  particles.pusher.tip_friction = species.law == physics::ParticleLaw::Measured ? 0.0 : 0.3;
  particles.pusher.lateral_spring_n_per_m = 10.0;
  particles.pusher.normal_spring_n_per_m = 1.0;
  particles.pusher.contact_stiffness_n_per_m = 100.0;
  particles.species[particles.species_count++] = species;
  for (const PlaceM& place : places) particles.particles[particles.count++] = {.x_m = place.x, .y_m = place.y};
  return particles;
}

// Spheres of 30 nm that the tip lifts off the sample, and a pad around (200 nm, 50 nm) with a stronger hold.
inline scene::SharedParticles particles_to_lift(const std::vector<PlaceM>& places) {
  scene::SharedSpecies species = gold_species();
  species.radius_m = 15e-9;
  species.work_of_adhesion_j_per_m2 = 0.02;
  species.law = physics::ParticleLaw::Amontons;
  species.rolling_distance_m = 0.0;
  species.tip_adhesion_j_per_m2 = 0.06;
  species.sticks = 1;
  scene::SharedParticles particles = particles_at(places, species);
  particles.pusher.tip_radius_m = 20e-9;
  particles.pads[0] = {
      .x_m = 200e-9, .y_m = 50e-9, .half_width_m = 35e-9, .half_height_m = 35e-9, .work_of_adhesion_j_per_m2 = 0.2};
  return particles;
}

// Flat islands of 200 nm, 50 nm high, that yield at 30 nN.
inline scene::SharedParticles islands_at(const std::vector<PlaceM>& places) {
  scene::SharedParticles particles = particles_at(places, constant_species(30e-9, 0.5));
  particles.island_radius_m[0] = 100e-9;
  particles.pusher.tip_friction = 0.3;
  particles.pusher.lateral_spring_n_per_m = 50.0;
  particles.pusher.normal_spring_n_per_m = 5.0;
  return particles;
}

// Distance of tip and first particle at touch, with the apex on the sample.
inline double touch_m(const scene::SharedParticles& particles) {
  const physics::PushSetup setup = scene::push_setup(particles);
  return physics::core_radius(setup.species.front()).si +
         physics::side_contact(setup.tip, setup.species.front().contact.tip_radius, physics::Length(0.0)).distance.si;
}

inline void expect_relative(double actual, double expected, double tolerance) {
  EXPECT_NEAR(actual, expected, tolerance * std::abs(expected));
}

// Model with the paper's materials, and three of these spheres in a row along x.
inline scene::SharedModel model_with_particles() {
  scene::SharedModel model = paper_model();
  model.particles = particles_at({{-80e-9, 0.0}, {0.0, 0.0}, {80e-9, 0.0}});
  return model;
}

}  // namespace afm::test
