// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/units.h"
#include "scene/samples/sourced_value.h"

namespace afm::scene {

// A straight move of the scripted hand, that is of the lever's base.
struct HandMove {
  physics::LeverBase to;
  physics::Velocity speed;
};

// A species of particles as in a file.
struct SpeciesEntry {
  std::string name;
  std::vector<SourcedValue> sources;
};

// Particles on a sample, the tip that pushes them, and a hand that moves it.
struct ParticleSet {
  std::string title;
  std::string medium;  // "air"
  std::string note;    // may be empty
  physics::PushSetup setup;
  std::vector<SpeciesEntry> species;  // names of setup.species, in order
  std::vector<physics::PlacedParticle> particles;
  physics::LeverBase start;
  std::vector<HandMove> moves;
  std::vector<SourcedValue> sources;  // sources of tip and lever
};

// Reads a particle file (TOML, assets/particles; docs/manual.md lists its keys). The error names file, line, key and
// reason.
core::Result<ParticleSet> load_particle_set(const std::string& path);

}  // namespace afm::scene
