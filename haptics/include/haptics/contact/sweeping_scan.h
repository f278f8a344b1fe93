// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "physics/manipulation/pushed_particles.h"
#include "scene/shared/particle_blocks.h"
#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// A look at particles by a scan whose load is above the gentle one (physics::climbing_load): its tip stays on the
// sample and sweeps the particles that it cannot climb. physics::kLookLines lines along x, each from left to right,
// from below; the tip is lifted on its way back, so that particles drift in the direction of M71. It is not felt, so
// that its lever has the springs of the set. Pinned particles and those of a species for which the load is gentle are
// climbed.
//
// The constructor allocates; everything else may be called in a tick of the servo, by its thread.
class SweepingScan {
 public:
  static constexpr double kLineS = 0.1;       // time of a line, there and back
  static constexpr double kTraceShare = 0.8;  // share of a line's time in which the tip is on the sample

  // `particles` are valid (scene::validate).
  explicit SweepingScan(const scene::SharedParticles& particles);

  // True if a scan with this load sweeps particles of a species that is there.
  bool sweeps(double load_n) const noexcept;

  // True if this look is the one that has begun.
  bool goes_on(const scene::ScanLead& look) const noexcept;

  // Begins a look at particles that lie as in these pages.
  void begin(const scene::ScanLead& look, std::span<const scene::ParticlePage> pages) noexcept;
  void end() noexcept { begun_ = false; }

  // Moves the tip; only after begin(). `drift_m`: way of the sample below the scanner.
  const physics::PushTick& step(const glm::dvec2& drift_m, double elapsed_s) noexcept;

  // The particles, of which PushedParticles::moved() are those of the newest step.
  const physics::PushedParticles& particles() const noexcept { return particles_; }

 private:
  bool covers(std::size_t particle, const glm::dvec2& place_m) const noexcept;
  bool is_over(const glm::dvec2& place_m) const noexcept;
  void lift(const glm::dvec2& place_m) noexcept;

  physics::PushSetup setup_;
  physics::PushedParticles particles_;
  physics::Length clear_;
  std::vector<double> climbs_n_;        // load up to which each particle is climbed; infinite if it is pinned
  std::vector<double> reach_m_;         // distance at which the tip touches each particle
  std::vector<std::uint32_t> climbed_;  // particles that this look climbs
  scene::ScanLead look_;
  double time_s_ = 0;  // time since the beginning of the look
  bool begun_ = false;
  bool down_ = false;  // true: the tip is on the sample
};

}  // namespace afm::haptics
