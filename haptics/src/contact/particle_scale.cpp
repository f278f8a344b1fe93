// SPDX-License-Identifier: Apache-2.0
#include "haptics/particle_scale.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "haptics/scaling.h"
#include "physics/manipulation/ink.h"
#include "physics/manipulation/particle_friction.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/scratching_tip.h"
#include "physics/manipulation/tip_contact.h"
#include "physics/manipulation/tip_hold.h"

namespace afm::haptics {

namespace {

// Softest contact of tip and particle relative to the lever that is felt: stiffer ones indent by less than a
// hundredth of what the lever bends, and only make the descent of several particles slower.
constexpr double kContactOverLever = 100.0;
constexpr double kSoftRadii = 12.0;   // side of the part of a soft sample that every hand reaches, in tip radii
constexpr double kInkDots = 6.0;      // side of the part of an inked sample that every hand reaches, in dots
constexpr double kLeastSlope = 1e-3;  // smallest slope of a flank by which its climb is divided

// Radius seen from above.
double outer_m(const scene::SharedParticles& particles, std::uint32_t species) {
  return std::max(particles.species[species].radius_m, particles.island_radius_m[species]);
}

// Species of the particle of median radius.
std::size_t median_species(const scene::SharedParticles& particles) {
  std::vector<std::uint32_t> species;
  species.reserve(particles.count);
  for (std::uint32_t i = 0; i < particles.count; ++i) species.push_back(particles.particles[i].species);
  const auto middle = species.begin() + static_cast<std::ptrdiff_t>(species.size() / 2);
  std::nth_element(species.begin(), middle, species.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return outer_m(particles, a) < outer_m(particles, b); });
  return *middle;
}

// Metres of hand per metre at which a way of particles fills its share of the workspace's.
double field_m_per_m(double way_m, double least_m, double most_m, double contact_m) {
  // from the contact point, as a recording has it
  const double room_m = (most_m - contact_m) - (least_m - contact_m);
  return way_m > 0.0 ? ParticleScale::kFieldShare * room_m / way_m : HUGE_VAL;
}

double hand_m_per_m(const scene::SharedParticles& particles, double diameter_m, const DeviceSpec& device) {
  double left_m = HUGE_VAL, right_m = -HUGE_VAL, front_m = HUGE_VAL, back_m = -HUGE_VAL;
  for (std::uint32_t i = 0; i < particles.count; ++i) {
    const scene::SharedParticle& particle = particles.particles[i];
    const double half_m = 0.5 * particles.length_m.at(particle.species);  // reach of a rod in any direction
    left_m = std::min(left_m, particle.x_m - half_m);
    right_m = std::max(right_m, particle.x_m + half_m);
    front_m = std::min(front_m, particle.y_m - half_m);
    back_m = std::max(back_m, particle.y_m + half_m);
  }
  // on a table, the sample's y is the device's -z
  return std::min(
      {particles.pusher.diameter_in_hand_m / diameter_m,
       field_m_per_m(right_m - left_m, device.workspace_min_m.x, device.workspace_max_m.x, device.contact_point_m.x),
       field_m_per_m(back_m - front_m, device.workspace_min_m.z, device.workspace_max_m.z, device.contact_point_m.z)});
}

// Metres of hand per metre where something of this diameter has the size of a hand, and a square of this side fills its
// share of the workspace. The sample may be larger, since a smaller scale would leave a hand too slow.
double marks_m_per_m(const scene::SharedPusher& pusher, double diameter_m, double side_m, const DeviceSpec& device) {
  return std::min(
      {pusher.diameter_in_hand_m / diameter_m,
       field_m_per_m(side_m, device.workspace_min_m.x, device.workspace_max_m.x, device.contact_point_m.x),
       field_m_per_m(side_m, device.workspace_min_m.z, device.workspace_max_m.z, device.contact_point_m.z)});
}

}  // namespace

physics::PushSprings felt_springs(const scene::SharedPusher& pusher, const ParticleScale& scale) {
  return {.lateral = physics::Stiffness(pusher.lateral_spring_n_per_m / scale.softened_sideways),
          .normal = physics::Stiffness(pusher.normal_spring_n_per_m / scale.softened_upwards),
          .contact = physics::Stiffness(pusher.contact_stiffness_n_per_m)};
}

core::Result<ParticleScale> soft_scale(const scene::SharedParticles& particles, const DeviceSpec& device) {
  const scene::SharedPusher& pusher = particles.pusher;
  const physics::SoftSurface surface = scene::soft_surface(particles.soft);
  // the load of a groove as wide as the tip's radius: 2 F = pi H r^2
  const double half_m = 0.5 * pusher.tip_radius_m;
  const double load_n = 0.5 * std::numbers::pi * surface.hardness.si * half_m * half_m;
  const double felt_n = std::min(pusher.threshold_on_hand_n, ParticleScale::kSoftShare * force_cap_n(device));
  ParticleScale scale{
      .hand_m_per_m = marks_m_per_m(pusher, 2.0 * pusher.tip_radius_m, kSoftRadii * pusher.tip_radius_m, device),
      .hand_n_per_n = felt_n / load_n,
      .clear_z_m = pusher.tip_radius_m,
      .softened_sideways = 1,
      .softened_upwards = 1};
  const double most_n_per_m = particle_stiffness_n_per_m(device) * scale.hand_m_per_m / scale.hand_n_per_n;
  scale.softened_sideways = std::max(1.0, pusher.lateral_spring_n_per_m / most_n_per_m);
  scale.softened_upwards = std::max(1.0, pusher.normal_spring_n_per_m / most_n_per_m);
  const double faintest_n = std::min(felt_n, load_n * scale.hand_n_per_n);
  if (!(faintest_n >= Scaling::kFaintestPullN)) {
    return core::failure(
        core::ErrorCategory::Failed,
        fmt::format("cannot scratch \"{}\" with the {}: a groove would be felt with {:.2g} N, too little; choose "
                    "another device",
                    particles.soft.name.data(), device.name, faintest_n));
  }
  try {
    physics::validate_lever(felt_springs(pusher, scale));
  } catch (const std::invalid_argument& error) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot scratch \"{}\" with a lever as soft as a hand can bear: {}",
                                     particles.soft.name.data(), error.what()));
  }
  return scale;
}

core::Result<ParticleScale> ink_scale(const scene::SharedParticles& particles, const DeviceSpec& device) {
  const scene::SharedPusher& pusher = particles.pusher;
  const double dot_m = scene::ink_dot_m(scene::ink_of(particles.ink));
  const double pull_n = scene::meniscus_pull_n(pusher.tip_radius_m, particles.ink.surface_tension_n_per_m);
  const double felt_n = std::min(pusher.threshold_on_hand_n, ParticleScale::kSoftShare * force_cap_n(device));
  if (!(felt_n >= Scaling::kFaintestPullN)) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot write with \"{}\" and the {}: the liquid would pull with {:.2g} N, too "
                                     "little to feel; choose another device",
                                     particles.ink.name.data(), device.name, felt_n));
  }
  ParticleScale scale{.hand_m_per_m = marks_m_per_m(pusher, dot_m, kInkDots * dot_m, device),
                      .hand_n_per_n = felt_n / pull_n,
                      .clear_z_m = 0,
                      .softened_sideways = 1,
                      .softened_upwards = 1};
  const double most_n_per_m = particle_stiffness_n_per_m(device) * scale.hand_m_per_m / scale.hand_n_per_n;
  scale.softened_upwards = std::max(1.0, pusher.normal_spring_n_per_m / most_n_per_m);
  scale.clear_z_m = pull_n * scale.softened_upwards / pusher.normal_spring_n_per_m;
  return scale;
}

double particle_stiffness_n_per_m(const DeviceSpec& device) {
  return std::min(ParticleScale::kMaxStiffnessNPerM, 0.5 * device.max_stiffness_n_per_m);
}

core::Result<ParticleScale> particle_scale(const scene::SharedParticles& particles, const DeviceSpec& device) {
  ParticleScale scale;
  if (particles.soft.hardness_pa > 0.0) return soft_scale(particles, device);
  if (particles.ink.molecules_per_s > 0.0) return ink_scale(particles, device);
  if (particles.count == 0) return scale;
  const physics::PushSetup setup = scene::push_setup(particles);
  const std::size_t median = median_species(particles);
  const physics::ParticleSpecies& species = setup.species[median];
  const physics::Length radius = species.contact.tip_radius;

  const physics::TipGrip grip = physics::flank_grip(setup.tip, species, setup.tip_friction);
  const double sine = std::sin(setup.tip.half_angle_rad), cosine = std::cos(setup.tip.half_angle_rad);
  const double threshold_n = physics::push_balance(species, grip, sine, cosine).lateral.si;
  if (!(std::isfinite(threshold_n) && threshold_n > 0.0)) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot push the particles \"{}\": they jam under this tip; choose less friction "
                                     "or a steeper tip",
                                     particles.species[median].name.data()));
  }
  const double diameter_m = 2.0 * physics::outer_radius(species).si;
  scale.hand_m_per_m = hand_m_per_m(particles, diameter_m, device);
  double distance_m = physics::side_contact(setup.tip, radius, physics::Length(0.0)).distance.si;
  if (physics::is_island(species)) {  // no push round an island: the tip would ride over it first
    const double climb_m = physics::crest_height(setup.tip, radius).si * cosine / std::max(sine, kLeastSlope);
    distance_m = std::min(distance_m + physics::core_radius(species).si, std::max(0.0, climb_m));
  }
  const double most_n = particle_stiffness_n_per_m(device) * ParticleScale::kMostBend * distance_m * scale.hand_m_per_m;
  double pull_n = 0.0;
  for (const physics::ParticleSpecies& s : setup.species) {
    pull_n = std::max(pull_n, physics::strongest_pull(setup.tip, s).si);
  }
  // neither the push that moves a particle nor the pull at which a contact tears is beyond the device
  const double cap_n = force_cap_n(device), strongest_n = std::max(threshold_n, pull_n);
  const double felt_n =
      std::min({particles.pusher.threshold_on_hand_n, most_n, cap_n, cap_n * (threshold_n / strongest_n)});
  if (!(felt_n >= Scaling::kFaintestPullN)) {
    return core::failure(
        core::ErrorCategory::Failed,
        fmt::format("cannot push the particles \"{}\" with the {}: they would be {:.2g} mm wide in the hand and give "
                    "at {:.2g} N, too little to feel; put them closer together",
                    particles.species[median].name.data(), device.name, 1e3 * diameter_m * scale.hand_m_per_m, felt_n));
  }
  scale.hand_n_per_n = felt_n / threshold_n;
  const double most_n_per_m = particle_stiffness_n_per_m(device) * scale.hand_m_per_m / scale.hand_n_per_n;
  scale.softened_sideways = std::max(1.0, setup.springs.lateral.si / most_n_per_m);
  scale.softened_upwards = std::max(1.0, setup.springs.normal.si / most_n_per_m);
  const physics::PushSetup felt = felt_setup(particles, scale);
  scale.clear_z_m = physics::clear_height(felt).si;
  try {
    physics::validate(felt);
  } catch (const std::invalid_argument& error) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("cannot push the particles \"{}\" with a lever as soft as a hand can bear: {}",
                                     particles.species[median].name.data(), error.what()));
  }
  return scale;
}

physics::PushSetup felt_setup(const scene::SharedParticles& particles, const ParticleScale& scale) {
  physics::PushSetup setup = scene::push_setup(particles);
  physics::PushSprings& springs = setup.springs;
  springs.lateral = springs.lateral / scale.softened_sideways;
  springs.normal = springs.normal / scale.softened_upwards;
  springs.contact = std::min(springs.contact, kContactOverLever * std::max(springs.lateral, springs.normal));
  return setup;
}

}  // namespace afm::haptics
