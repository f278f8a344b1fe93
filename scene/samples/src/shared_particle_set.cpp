// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <utility>

#include "core/check.h"
#include "particle_field.h"
#include "scene/samples/adjusted_set.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_files.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/scratch_run.h"
#include "scene/shared/push_values.h"

// Conversion of a set for a shared scene, and back.
namespace afm::scene {

using physics::Length;

ParticleField field_of(const ParticleSet& set) {
  if (set.particles.empty()) return {};
  ParticleField field{set.particles.front().position, set.particles.front().position};
  for (const physics::PlacedParticle& particle : set.particles) {
    const physics::Sideways<Length>& place = particle.position;
    const Length half = 0.5 * set.setup.species[particle.species].length;
    field.least = {std::min(field.least.x, place.x - half), std::min(field.least.y, place.y - half)};
    field.most = {std::max(field.most.x, place.x + half), std::max(field.most.y, place.y + half)};
  }
  return field;
}

namespace {

// Stores the soft sample or the ink of the set.
void share_marks(const ParticleSet& set, SharedParticles& shared) {
  if (set.soft) {
    const physics::SoftSurface& surface = set.soft->surface;
    shared.soft = {.name = to_name(set.soft->name),
                   .hardness_pa = surface.hardness.si,
                   .reduced_modulus_pa = surface.reduced_modulus.si,
                   .work_of_adhesion_j_per_m2 = surface.work_of_adhesion.si,
                   .pile_up_share = surface.pile_up_share};
  }
  if (set.ink) {
    shared.ink = {.name = to_name(set.ink->name),
                  .molecules_per_s = set.ink->ink.molecules_per_s,
                  .footprint_m2 = set.ink->ink.footprint.si,
                  .thickness_m = set.ink->thickness.si,
                  .surface_tension_n_per_m = set.ink->surface_tension.si};
  }
}

}  // namespace

SharedParticles shared_particles(const ParticleSet& set) {
  AFM_CHECK(set.species.size() <= kMaxSpecies && set.setup.species.size() == set.species.size() &&
            set.particles.size() <= kMaxParticles);
  SharedParticles shared;
  shared.pusher.tip_radius_m = set.setup.tip.radius.si;
  shared.pusher.half_angle_rad = set.setup.tip.half_angle_rad;
  shared.pusher.tip_friction = set.setup.tip_friction;
  shared.pusher.lateral_spring_n_per_m = set.setup.springs.lateral.si;
  shared.pusher.normal_spring_n_per_m = set.setup.springs.normal.si;
  shared.pusher.contact_stiffness_n_per_m = set.setup.springs.contact.si;
  for (const physics::ParticleSpecies& species : set.setup.species) {
    shared.species.at(shared.species_count) = {.name = to_name(set.species[shared.species_count].name),
                                               .radius_m = species.contact.tip_radius.si,
                                               .reduced_modulus_pa = species.contact.reduced_modulus.si,
                                               .work_of_adhesion_j_per_m2 = species.contact.work_of_adhesion.si,
                                               .shear_strength_pa = species.shear_strength.si,
                                               .coefficient = species.coefficient,
                                               .measured_threshold_n = species.measured_threshold.si,
                                               .kinetic_ratio = species.kinetic_ratio,
                                               .ageing_s = species.ageing.si,
                                               .rolling_distance_m = species.rolling_distance.si,
                                               .tip_adhesion_j_per_m2 = species.tip_adhesion.si,
                                               .law = species.law,
                                               .sticks = static_cast<std::uint16_t>(species.sticks ? 1 : 0),
                                               .scatter_seed = species.scatter_seed};
    shared.length_m.at(shared.species_count) = species.length.si;
    shared.island_radius_m.at(shared.species_count) = species.island_radius.si;
    ++shared.species_count;
  }
  share_marks(set, shared);
  const physics::Sideways<Length> middle = field_of(set).middle();
  for (const physics::PlacedParticle& particle : set.particles) {
    shared.angle_rad.at(shared.count) = particle.angle_rad;
    shared.particles.at(shared.count++) = {.x_m = (particle.position - middle).x.si,
                                           .y_m = (particle.position - middle).y.si,
                                           .species = static_cast<std::uint32_t>(particle.species),
                                           .pinned = particle.pinned ? 1U : 0U};
  }
  const std::vector<physics::StickyPad> pads = shared_sticky_pads(set);
  std::transform(pads.begin(), pads.end(), shared.pads.begin(), [](const physics::StickyPad& pad) {
    return SharedPad{.x_m = pad.middle.x.si,
                     .y_m = pad.middle.y.si,
                     .half_width_m = pad.half_size.x.si,
                     .half_height_m = pad.half_size.y.si,
                     .work_of_adhesion_j_per_m2 = pad.work_of_adhesion.si};
  });
  return shared;
}

std::vector<physics::ParticlePlace> shared_targets(const ParticleSet& set) {
  std::vector<physics::ParticlePlace> targets = set.targets;
  const physics::Sideways<Length> middle = field_of(set).middle();
  for (physics::ParticlePlace& target : targets) target.position = target.position - middle;
  return targets;
}

std::vector<Pad> shared_pads(const ParticleSet& set) {
  std::vector<Pad> pads = set.pads;
  const physics::Sideways<Length> middle = field_of(set).middle();
  for (Pad& pad : pads) pad.middle = pad.middle - middle;
  return pads;
}

std::vector<physics::StickyPad> shared_sticky_pads(const ParticleSet& set) {
  AFM_CHECK(set.setup.pads.size() <= physics::kMostStickyPads);
  std::vector<physics::StickyPad> pads = set.setup.pads;
  const physics::Sideways<Length> middle = field_of(set).middle();
  for (physics::StickyPad& pad : pads) pad.middle = pad.middle - middle;
  return pads;
}

Length median_radius(const ParticleSet& set) {
  if (set.particles.empty()) return set.setup.tip.radius;
  std::vector<Length> radii;
  radii.reserve(set.particles.size());
  for (const physics::PlacedParticle& p : set.particles) {
    radii.push_back(physics::outer_radius(set.setup.species[p.species]));
  }
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

ParticleSet recorded_set(const SharedParticles& recorded, const std::string& assets_dir) {
  const auto plain = std::make_unique<SharedParticles>(recorded);
  plain->level = {};  // level chosen by a user, not part of a set
  for (const std::string& name : particle_sets(assets_dir)) {
    const auto path = particle_file(name, assets_dir);
    auto set = path ? load_particle_set(*path) : tl::unexpected(path.error());
    if (!set) continue;
    const auto shared = std::make_unique<SharedParticles>(shared_particles(*set));
    if (shared->particles != plain->particles) continue;
    if (const auto settings = settings_between(*shared, *plain)) return adjusted(*set, *settings);
  }
  ParticleSet set;
  set.title = "Recorded particles";
  set.medium = "air";
  if (has_marks(recorded)) {
    set.setup.tip = {Length(recorded.pusher.tip_radius_m), recorded.pusher.half_angle_rad};
    set.setup.springs = {.lateral = physics::Stiffness(recorded.pusher.lateral_spring_n_per_m),
                         .normal = physics::Stiffness(recorded.pusher.normal_spring_n_per_m),
                         .contact = physics::Stiffness(recorded.pusher.contact_stiffness_n_per_m)};
    if (recorded.soft.hardness_pa > 0.0) {
      set.title = "Recorded soft sample";
      set.soft = std::make_shared<const SoftSample>(
          SoftSample{.name = recorded.soft.name.data(), .surface = soft_surface(recorded.soft)});
    } else {
      set.title = "Recorded ink";
      set.ink = std::make_shared<const InkSample>(
          InkSample{.name = recorded.ink.name.data(),
                    .ink = ink_of(recorded.ink),
                    .thickness = Length(recorded.ink.thickness_m),
                    .surface_tension = physics::SurfaceEnergy(recorded.ink.surface_tension_n_per_m)});
    }
    return set;
  }
  set.setup = push_setup(recorded);
  set.particles = start_places(recorded);
  for (std::uint32_t i = 0; i < recorded.species_count; ++i) {
    set.species.push_back({.name = recorded.species[i].name.data(), .sources = {}});
  }
  return set;
}

}  // namespace afm::scene
