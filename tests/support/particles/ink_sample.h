// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "scene/shared/particle_blocks.h"
#include "support/paper_model.h"

// Ink for tests that need no files, with the numbers of assets/particles/write-ink.toml.
namespace afm::test {

inline scene::SharedParticles thiol_ink() {
  scene::SharedParticles particles;
  particles.pusher.tip_radius_m = 20e-9;
  particles.pusher.half_angle_rad = std::numbers::pi / 9.0;
  particles.pusher.lateral_spring_n_per_m = particles.pusher.normal_spring_n_per_m = 0.1;
  particles.ink = {.name = scene::to_name("a thiol on gold"),
                   .molecules_per_s = 1e5,
                   .footprint_m2 = 0.216e-18,
                   .thickness_m = 2e-9,
                   .surface_tension_n_per_m = 0.0728};
  return particles;
}

// Model with the paper's materials; on the scale Particles a tip writes with ink.
inline scene::SharedModel ink_model() {
  scene::SharedModel model = paper_model();
  model.particles = thiol_ink();
  return model;
}

}  // namespace afm::test
