// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "scene/shared/particle_blocks.h"

namespace afm::scene {
struct ParticleSet;
}

namespace afm::exhibit {

// Particles on the stage, as the servo has moved them. All that is referred to must outlive the object.
struct ParticlesNow {
  const scene::ParticleSet* set = nullptr;       // not null
  std::span<const scene::ParticlePage> pages{};  // poses; a particle beyond them is where it started
  scene::TipPush push{};
};

// Pose of a particle; nothing beyond the pages.
inline std::optional<scene::ParticlePose> pose_of(const ParticlesNow& now, std::size_t particle) {
  const std::size_t page = particle / scene::kPosesPerPage;
  if (page >= now.pages.size()) return std::nullopt;
  return now.pages[page].poses[particle % scene::kPosesPerPage];
}

// Particle that the tip touches, if there is one.
inline std::optional<std::size_t> touched(const ParticlesNow& now, std::size_t count) {
  const bool known = now.push.met != 0 && now.push.particle >= 0 && static_cast<std::size_t>(now.push.particle) < count;
  return known ? std::optional(static_cast<std::size_t>(now.push.particle)) : std::nullopt;
}

// How near the particles are to the pattern of their set; nothing if it has none.
struct PatternNow {
  double off_m = 0;      // physics::PatternMatch::rms
  double allowed_m = 0;  // largest of a pattern that is done

  bool done() const { return off_m <= allowed_m; }
};
std::optional<PatternNow> pattern_of(const ParticlesNow& now);

}  // namespace afm::exhibit
