// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "physics/units.h"
#include "scene/shared/particle_blocks.h"
#include "scene/shared/task_score.h"

namespace afm::physics {
struct ParticlePlace;
}

namespace afm::servo {
struct PictureNow;
enum class Known : std::uint8_t;
}  // namespace afm::servo

namespace afm::scene {
struct ParticleSet;
struct PatternState;
struct PushLimits;
}  // namespace afm::scene

namespace afm::exhibit {

// Particles on the stage, or the marks of a soft sample, as the servo has moved them, or with a picture as that shows
// them. All that is referred to must outlive the object.
struct ParticlesNow {
  const scene::ParticleSet* set = nullptr;       // not null; with the settings of `push`, or its own
  std::span<const scene::ParticlePage> pages{};  // poses; a particle beyond them is where it started
  scene::TipPush push{};
  scene::TaskScore score{};  // only for a set with a pattern
  scene::PlannedPush plan{};
  const servo::PictureNow* picture = nullptr;              // at level 1 and 2
  double look_load_n = 0;                                  // with which the next look scans
  std::span<const scene::MarkTile> tiles{};                // marks of a soft sample
  std::uint64_t marks = 0;                                 // number of the tiles' state, different for other tiles
  const std::vector<scene::PushLimits>* limits = nullptr;  // limits of each species; null: not known
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

// Source of a particle's place in the picture; Measured without a picture, which shows the particles themselves.
servo::Known known_of(const ParticlesNow& now, std::size_t particle);

// Load up to which a look moves no particle of the set.
physics::Force gentle_look(const scene::ParticleSet& set);

// Places of all particles; empty before the servo has reported them.
std::optional<std::vector<physics::ParticlePlace>> places_of(const ParticlesNow& now);

// Empty if the set has no pattern, or before the servo has reported the places of the particles.
std::optional<scene::PatternState> pattern_of(const ParticlesNow& now);

}  // namespace afm::exhibit
