// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/particle_blocks.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/enumerators.h"
#include "physics/manipulation/ink.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/scratching_tip.h"
#include "physics/manipulation/tip_hold.h"
#include "scene/shared/shared_segment.h"

namespace afm::scene {

namespace {

// Largest and smallest size of a particle and of its threshold in a hand.
constexpr double kSmallestInHandM = 1e-4, kLargestInHandM = 1.0;
constexpr double kFaintestOnHandN = 0.01, kStrongestOnHandN = 10.0;
constexpr double kSmallestDotM = 1e-9, kLargestDotM = 1e-3;  // limits for the diameter of a one-second dot

physics::ParticleSpecies species_of(const SharedSpecies& shared) {
  return {.contact = {.tip_radius = physics::Length(shared.radius_m),
                      .reduced_modulus = physics::Pressure(shared.reduced_modulus_pa),
                      .work_of_adhesion = physics::SurfaceEnergy(shared.work_of_adhesion_j_per_m2)},
          .law = shared.law,
          .shear_strength = physics::Pressure(shared.shear_strength_pa),
          .coefficient = shared.coefficient,
          .measured_threshold = physics::Force(shared.measured_threshold_n),
          .kinetic_ratio = shared.kinetic_ratio,
          .ageing = physics::Time(shared.ageing_s),
          .rolling_distance = physics::Length(shared.rolling_distance_m),
          .tip_adhesion = physics::SurfaceEnergy(shared.tip_adhesion_j_per_m2),
          .length = {},
          .sticks = shared.sticks != 0,
          .scatter_seed = shared.scatter_seed,
          .island_radius = {}};
}

bool is_there(const SharedPad& pad) { return pad.work_of_adhesion_j_per_m2 != 0.0; }

physics::StickyPad pad_of(const SharedPad& shared) {
  return {.middle = {physics::Length(shared.x_m), physics::Length(shared.y_m)},
          .half_size = {physics::Length(shared.half_width_m), physics::Length(shared.half_height_m)},
          .work_of_adhesion = physics::SurfaceEnergy(shared.work_of_adhesion_j_per_m2)};
}

// splitmix64 (Steele, Lea & Flood 2014).
std::uint64_t mixed(std::uint64_t word) {
  word += 0x9E3779B97F4A7C15ULL;
  word = (word ^ (word >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  word = (word ^ (word >> 27U)) * 0x94D049BB133111EBULL;
  return word ^ (word >> 31U);
}

auto particles_refused(std::string message) { return core::failure(core::ErrorCategory::Failed, std::move(message)); }

bool can_be_felt(const SharedPusher& pusher) {
  return pusher.diameter_in_hand_m >= kSmallestInHandM && pusher.diameter_in_hand_m <= kLargestInHandM &&
         pusher.threshold_on_hand_n >= kFaintestOnHandN && pusher.threshold_on_hand_n <= kStrongestOnHandN;
}

core::Result<void> validate_soft(const SharedParticles& particles) {
  if (particles.count != 0) return particles_refused("a soft sample in the shared scene has particles");
  if (particles.soft.name.back() != '\0' || !can_be_felt(particles.pusher) || particles.level.level != 0) {
    return particles_refused("the name, the size in a hand or the level of a soft sample is invalid");
  }
  const SharedPusher& pusher = particles.pusher;
  try {
    physics::validate(soft_surface(particles.soft));
    physics::validate_marking_tip({physics::Length(pusher.tip_radius_m), pusher.half_angle_rad});
    physics::validate_lever({.lateral = physics::Stiffness(pusher.lateral_spring_n_per_m),
                             .normal = physics::Stiffness(pusher.normal_spring_n_per_m),
                             .contact = physics::Stiffness(pusher.contact_stiffness_n_per_m)});
  } catch (const std::invalid_argument& error) {
    return particles_refused(fmt::format("the soft sample of the shared scene: {}", error.what()));
  }
  return {};
}

core::Result<void> validate_ink(const SharedParticles& particles) {
  const SharedInk& ink = particles.ink;
  const SharedPusher& pusher = particles.pusher;
  if (particles.count != 0) return particles_refused("ink in the shared scene has particles");
  if (ink.name.back() != '\0' || !can_be_felt(pusher) || particles.level.level != 0) {
    return particles_refused("the name, the size in a hand or the level of ink is invalid");
  }
  if (!(ink.thickness_m > 0.0 && ink.thickness_m <= kThickestLayerM) || !(ink.surface_tension_n_per_m > 0.0) ||
      !std::isfinite(ink.surface_tension_n_per_m)) {
    return particles_refused("the thickness or the surface tension of ink in the shared scene is impossible");
  }
  try {
    physics::validate(ink_of(ink));
    const double dot_m = ink_dot_m(ink_of(ink));
    if (!(dot_m >= kSmallestDotM && dot_m <= kLargestDotM)) {
      return particles_refused(
          fmt::format("ink of the shared scene makes dots of {:.2g} m in a second, and a hand writes with "
                      "dots of 1 nm to 1 mm",
                      dot_m));
    }
    physics::validate_marking_tip({physics::Length(pusher.tip_radius_m), pusher.half_angle_rad});
    const physics::Stiffness normal(pusher.normal_spring_n_per_m);
    physics::validate_lever({.lateral = normal, .normal = normal, .contact = {}});
  } catch (const std::invalid_argument& error) {
    return particles_refused(fmt::format("the ink of the shared scene: {}", error.what()));
  }
  return {};
}

}  // namespace

physics::PushSetup push_setup(const SharedParticles& particles) {
  const SharedPusher& pusher = particles.pusher;
  physics::PushSetup setup;
  setup.tip = {.radius = physics::Length(pusher.tip_radius_m), .half_angle_rad = pusher.half_angle_rad};
  setup.springs = {.lateral = physics::Stiffness(pusher.lateral_spring_n_per_m),
                   .normal = physics::Stiffness(pusher.normal_spring_n_per_m),
                   .contact = physics::Stiffness(pusher.contact_stiffness_n_per_m)};
  setup.tip_friction = pusher.tip_friction;
  const auto end = particles.species.begin() + std::min(particles.species_count, kMaxSpecies);
  std::transform(particles.species.begin(), end, std::back_inserter(setup.species), species_of);
  for (std::size_t i = 0; i < setup.species.size(); ++i) {
    setup.species[i].length = physics::Length(particles.length_m[i]);
    setup.species[i].island_radius = physics::Length(particles.island_radius_m[i]);
    const bool even = setup.species[i].sticks && setup.species[i].scatter_seed == 0;
    if (particles.level.level > 1 && even) {
      setup.species[i].scatter_seed = static_cast<std::uint16_t>(particles.level.seed);
    }
  }
  for (const SharedPad& pad : particles.pads) {
    if (is_there(pad)) setup.pads.push_back(pad_of(pad));
  }
  return setup;
}

std::vector<physics::PlacedParticle> start_places(const SharedParticles& particles) {
  std::vector<physics::PlacedParticle> places;
  for (std::uint32_t i = 0; i < std::min(particles.count, kMaxParticles); ++i) {
    const SharedParticle& particle = particles.particles[i];
    places.push_back({.species = particle.species,
                      .position = {physics::Length(particle.x_m), physics::Length(particle.y_m)},
                      .pinned = particle.pinned != 0,
                      .angle_rad = particles.angle_rad[i]});
  }
  return places;
}

bool has_rods(const SharedParticles& particles) {
  return std::any_of(particles.length_m.begin(), particles.length_m.end(),
                     [](double length_m) { return length_m != 0.0; });
}

bool has_islands(const SharedParticles& particles) {
  return std::any_of(particles.island_radius_m.begin(), particles.island_radius_m.end(),
                     [](double radius_m) { return radius_m != 0.0; });
}

bool has_hold(const SharedParticles& particles) {
  return std::any_of(particles.species.begin(), particles.species.end(),
                     [](const SharedSpecies& species) { return species.sticks != 0; });
}

bool has_pads(const SharedParticles& particles) {
  return std::any_of(particles.pads.begin(), particles.pads.end(), is_there);
}

bool has_lift(const SharedParticles& particles) {
  const physics::PushSetup setup = push_setup(particles);
  return std::any_of(setup.species.begin(), setup.species.end(), [&](const physics::ParticleSpecies& species) {
    return species.sticks && physics::lifts_anywhere(setup, species);
  });
}

physics::HalfTurn turn_of(const ParticlePose& pose) noexcept {
  return pose.rod != 0 ? physics::HalfTurn{pose.orientation[0], pose.orientation[3]} : physics::HalfTurn{};
}

void set_turn(ParticlePose& pose, const physics::HalfTurn& turn) noexcept {
  pose.rod = 1;
  pose.orientation = {turn.w, 0.0, 0.0, turn.z};
}

std::uint64_t place_mark(std::size_t particle, const ParticlePose& pose) noexcept {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  const std::uint64_t turn = pose.rod != 0 ? mixed(bits(pose.orientation[0]) + mixed(bits(pose.orientation[3]))) : 0;
  return mixed(particle + mixed(bits(pose.x_m) + mixed(bits(pose.y_m) + turn)));
}

std::uint64_t digest_of(std::span<const ParticlePage> pages, std::size_t count) noexcept {
  std::uint64_t digest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    digest += place_mark(i, pages[i / kPosesPerPage].poses[i % kPosesPerPage]);
  }
  return digest;
}

std::string why_no_level(const SharedParticles& particles) {
  if (particles.count == 0) return "there are no particles";
  if (has_islands(particles)) return "only spheres and rods have a picture that grows old, and these are flat islands";
  if (has_lift(particles)) return "the tip lifts these spheres, and one that hangs on it hides what lies below";
  return {};
}

core::Result<void> validate(const SharedParticles& particles) {
  if (particles.soft.hardness_pa != 0.0) return validate_soft(particles);
  if (particles.ink.molecules_per_s != 0.0) return validate_ink(particles);
  if (particles.count == 0) return {};
  if (particles.count > kMaxParticles || particles.species_count == 0 || particles.species_count > kMaxSpecies) {
    return particles_refused(
        fmt::format("the shared scene has {} particles of {} species: the limits are {} particles and 1 to {} species",
                    particles.count, particles.species_count, kMaxParticles, kMaxSpecies));
  }
  for (std::uint32_t i = 0; i < particles.species_count; ++i) {
    const SharedSpecies& species = particles.species[i];
    if (species.name.back() != '\0' || !core::is_enumerator(species.law)) {
      return particles_refused(fmt::format("the name or the law of particle species {} is invalid", i));
    }
    if (species.sticks > 1) return particles_refused(fmt::format("the adhesion of particle species {} is invalid", i));
  }
  if (!can_be_felt(particles.pusher)) {
    return particles_refused("the size or the threshold of the particles in a hand is impossible");
  }
  const auto is_finite = [](const SharedParticle& p) {
    return std::isfinite(p.x_m) && std::isfinite(p.y_m) && p.pinned <= 1;
  };
  if (!std::all_of(particles.particles.begin(), particles.particles.begin() + particles.count, is_finite)) {
    return particles_refused("the place of a particle in the shared scene is invalid");
  }
  try {
    physics::validate(push_setup(particles), start_places(particles));
  } catch (const std::invalid_argument& error) {
    return particles_refused(fmt::format("the particles of the shared scene: {}", error.what()));
  }
  const SharedLevel& level = particles.level;
  const bool known =
      level.level <= kHighestLevel && level.seed >= 1 && level.seed <= kLargestSeed && level.since_ns >= 0;
  if (!known || (level.level > 0 && !why_no_level(particles).empty())) {
    return particles_refused("the level of the particles in the shared scene is impossible");
  }
  return {};
}

}  // namespace afm::scene
