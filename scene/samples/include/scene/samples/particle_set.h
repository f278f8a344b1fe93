// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "physics/friction/sideways.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/units.h"
#include "scene/samples/blind_task.h"
#include "scene/samples/sourced_value.h"
#include "scene/shared/particle_blocks.h"

namespace afm::scene {

// A move of the scripted hand, which holds the lever's base: straight, or a sweep (hand_script.h).
struct HandMove {
  physics::LeverBase to;
  physics::Velocity speed;
  physics::Time wait{};            // wait at the end of the move
  physics::Length sweep_width{};   // width of a sweep's lines; 0: straight move
  physics::Length line_spacing{};  // largest distance between a sweep's lines
};

// A species of particles as in a file.
struct SpeciesEntry {
  std::string name;
  std::vector<SourcedValue> sources;
};

// A flat rectangular electrode on the sample, to be touched by a rod. A pad to which spheres stick is
// a physics::StickyPad of the setup.
struct Pad {
  physics::Sideways<physics::Length> middle;
  physics::Sideways<physics::Length> half_size;
};

struct SoftSample;  // scene/samples/scratch_run.h
struct InkSample;   // scene/samples/ink_run.h

// Particles on a sample, the tip that pushes them, and a hand that moves it.
struct ParticleSet {
  std::string title;
  std::string medium;  // name of the medium, such as "air"
  std::string note;    // remark about the set; may be empty
  physics::PushSetup setup;
  std::vector<SpeciesEntry> species;  // names of setup.species, in order
  std::vector<physics::PlacedParticle> particles;
  std::vector<physics::ParticlePlace> targets;  // places of the pattern to be formed; may be empty
  std::vector<Pad> pads;                        // electrodes to be bridged by a rod; may be empty
  std::optional<BlindTask> blind;               // task that replaces the pattern
  physics::LeverBase start;
  std::vector<HandMove> moves;
  std::vector<SourcedValue> sources;  // sources of tip, lever, pads and soft sample
  // Soft sample; if set, there are no particles. Under a hand it is a square around its origin, whatever the moves.
  std::shared_ptr<const SoftSample> soft;
  // Ink; if set, there are neither particles nor a soft sample, and the square is the same. Without surface tension
  // there are neither tip nor lever, and only `touchafm particles` plays the set.
  std::shared_ptr<const InkSample> ink;
};

// True if the tip leaves marks instead of pushing particles.
inline bool leaves_marks(const ParticleSet& set) { return set.soft != nullptr || set.ink != nullptr; }

// True if a person who pushes the particles gets a score.
inline bool has_task(const ParticleSet& set) { return !set.targets.empty() || set.blind; }

inline constexpr std::size_t kMostTargets = 32;
inline constexpr std::size_t kMostPads = 8;

// Reads a particle file (TOML, assets/particles; docs/manual/particles.md lists its keys). The error names file, line,
// key and reason.
core::Result<ParticleSet> load_particle_set(const std::string& path);

// The same set for a shared scene: its middle is the origin of the sample, where a hand is in the middle of its device.
// A set that was loaded has no more species and particles than that can hold.
SharedParticles shared_particles(const ParticleSet& set);

// Targets and pads of both kinds in the same frame.
std::vector<physics::ParticlePlace> shared_targets(const ParticleSet& set);
std::vector<Pad> shared_pads(const ParticleSet& set);
std::vector<physics::StickyPad> shared_sticky_pads(const ParticleSet& set);

// Median radius of the particles, as seen from above; without any, the radius of the tip. A pattern is done when they
// are no farther from it (physics::PatternMatch).
physics::Length median_radius(const ParticleSet& set);

// The set of a recording, a valid one: that of the assets with the same particles, if there is one, with the settings
// of the recording; otherwise without words and sources.
ParticleSet recorded_set(const SharedParticles& recorded, const std::string& assets_dir);

}  // namespace afm::scene
