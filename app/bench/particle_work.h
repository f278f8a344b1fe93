// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/percentiles.h"
#include "core/result.h"

namespace afm::scene {
struct SharedParticles;
}

namespace afm::app {

// Duration of a servo tick while a hand drags the tip through particles, microseconds.
struct ParticleWorkFigure {
  std::string name;
  std::uint32_t particles = 0;  // number of spheres; 0: law without particles, along the same path
  core::Percentiles us;
  double p99_bar_us = 0;       // goal for the 99th percentile; 0: none
  double touching_share = 0;   // fraction of ticks in which the tip touches a particle
  double exhausted_share = 0;  // fraction of ticks whose budget ended before the particles were at rest

  bool met() const { return p99_bar_us == 0 || us.p99 <= p99_bar_us; }
};

// Ticks a servo loop whose simulated hand moves through spheres of 50 nm, the first species of `set`, on two fifths of
// the area or closer, and through a close heap, line by line, at up to 0.05 m/s of the hand; each round of lines begins
// with the spheres in their places. The first figure is the law alone.
core::Result<std::vector<ParticleWorkFigure>> measure_particle_work(const scene::SharedParticles& set,
                                                                    std::size_t ticks);

}  // namespace afm::app
