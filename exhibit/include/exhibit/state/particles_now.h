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

// Particles on the stage, or marks of a soft sample, as moved by the servo or, with a picture, as it shows
// them. All referenced objects must outlive this one.
struct ParticlesNow {
  const scene::ParticleSet* set = nullptr;       // never null; with the settings of `push`, or the set's own
  std::span<const scene::ParticlePage> pages{};  // poses; a particle beyond the pages is at its start
  scene::TipPush push{};
  scene::TaskScore score{};  // score of a set with a pattern
  scene::PlannedPush plan{};
  const servo::PictureNow* picture = nullptr;              // picture at levels 1 and 2; null: none
  double look_load_n = 0;                                  // load of the next second look
  std::span<const scene::MarkTile> tiles{};                // marks of a soft sample
  std::uint64_t marks = 0;                                 // counter that changes with the tiles
  const std::vector<scene::PushLimits>* limits = nullptr;  // limits of each species; null: unknown
};

// Pose of a particle; empty beyond the pages.
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

// Source of a particle's place in the picture; Measured if the particles themselves are shown.
servo::Known known_of(const ParticlesNow& now, std::size_t particle);

// Largest load at which a second look moves no particle of the set.
physics::Force gentle_look(const scene::ParticleSet& set);

// Places of all particles; empty until the servo has reported them.
std::optional<std::vector<physics::ParticlePlace>> places_of(const ParticlesNow& now);

// Empty if the set has no pattern, or until the servo has reported the places of the particles.
std::optional<scene::PatternState> pattern_of(const ParticlesNow& now);

}  // namespace afm::exhibit
