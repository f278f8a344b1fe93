// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "exhibit/state/particles_now.h"
#include "scene/samples/particle_files.h"
#include "scene/samples/particle_set.h"
#include "support/places.h"

namespace afm::test {

inline scene::ParticleSet particle_set(const std::string& name) {
  return scene::load_particle_set(scene::particle_file(name, support::source("assets")).value()).value();
}

// Pages of a set in which no particle has moved yet.
inline std::vector<scene::ParticlePage> start_pages(const scene::ParticleSet& set) {
  const auto shared = std::make_unique<const scene::SharedParticles>(scene::shared_particles(set));
  std::vector<scene::ParticlePage> pages(scene::pages_of(shared->count));
  for (std::uint32_t i = 0; i < shared->count; ++i) {
    scene::ParticlePose& pose = pages[scene::page_of(i)].poses[i % scene::kPosesPerPage];
    pose.x_m = shared->particles[i].x_m;
    pose.y_m = shared->particles[i].y_m;
    if (shared->length_m[shared->particles[i].species] > 0.0) {
      scene::set_turn(pose, physics::half_turn(shared->angle_rad[i]));
    }
  }
  return pages;
}

// Pages in which the pattern of a set is done, but not exactly.
inline std::vector<scene::ParticlePage> formed_pages(const scene::ParticleSet& set) {
  std::vector<scene::ParticlePage> pages = start_pages(set);
  std::uint32_t particle = 0;
  for (const auto& [target, turn] : scene::shared_targets(set)) {
    while (set.particles.at(particle).pinned) ++particle;
    scene::ParticlePose& pose = pages[scene::page_of(particle)].poses[particle % scene::kPosesPerPage];
    pose.x_m = target.x.si + 0.9 * scene::median_radius(set).si;
    pose.y_m = target.y.si;
    ++particle;
  }
  return pages;
}

// A push of that particle along x, from its left.
inline scene::TipPush push_of(const scene::ParticleSet& set, std::size_t particle, physics::PushState state) {
  const scene::ParticlePose pose =
      start_pages(set)[particle / scene::kPosesPerPage].poses[particle % scene::kPosesPerPage];
  const double radius_m = set.setup.species[set.particles[particle].species].contact.tip_radius.si;
  scene::TipPush push;
  push.met = 1;
  push.particle = static_cast<std::int32_t>(particle);
  push.state = state;
  push.normal_n = 0.31e-9;
  push.lateral_n = {0.24e-9, -0.07e-9};
  push.threshold_n = 0.25e-9;
  push.hand_m_per_m = 2e5;
  push.hand_n_per_n = 4e9;
  push.apex_m = {pose.x_m - 1.6 * radius_m, pose.y_m, 1e-9};
  push.base_m = push.apex_m;
  return push;
}

}  // namespace afm::test
