// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "physics/units.h"
#include "scene/samples/particle_set.h"

namespace afm::scene {

// The set with settings (scene/shared/push_values.h) that are valid: the numbers that they change, with their sources.
ParticleSet adjusted(const ParticleSet& set, const PushSettings& settings);

// Two thresholds that a user needs before a push (physics/manipulation/push_figures.h).
struct PushLimits {
  physics::Force gentle;       // climbing_load(); 0 for flat islands
  physics::Stiffness softest;  // softest_lever(); 0 for rods and flat islands
};

// Limits of each species of a set.
std::vector<PushLimits> push_limits(const ParticleSet& set);

// A set with the settings in use, and its limits; both are recomputed when the settings change. One thread.
class AdjustedSet {
 public:
  // `set` must outlive the object.
  explicit AdjustedSet(const ParticleSet& set) : set_(set), limits_(push_limits(set)) {}

  void use(const PushSettings& settings);  // sets valid settings

  const ParticleSet& set() const { return adjusted_ ? *adjusted_ : set_; }
  const std::vector<PushLimits>& limits() const { return limits_; }

 private:
  const ParticleSet& set_;
  PushSettings settings_{};
  std::unique_ptr<const ParticleSet> adjusted_;  // null: the set itself
  std::vector<PushLimits> limits_;
};

}  // namespace afm::scene
