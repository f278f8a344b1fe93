// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "scene/shared/particle_blocks.h"
#include "support/paper_model.h"

// PMMA for tests that need no files, with the tip and lever of assets/particles/scratch-pmma.toml.
namespace afm::test {

inline scene::SharedParticles soft_pmma() {
  scene::SharedParticles particles;
  particles.pusher.tip_radius_m = 20e-9;
  particles.pusher.half_angle_rad = std::numbers::pi / 9.0;
  particles.pusher.lateral_spring_n_per_m = 10.0;
  particles.pusher.normal_spring_n_per_m = 1.0;
  particles.soft = {.name = scene::to_name("PMMA"),
                    .hardness_pa = 0.3e9,
                    .reduced_modulus_pa = 3.4e9,
                    .work_of_adhesion_j_per_m2 = 0.08,
                    .pile_up_share = 0.7};
  return particles;
}

// Model with the paper's materials; on the scale Particles the sample is PMMA.
inline scene::SharedModel soft_model() {
  scene::SharedModel model = paper_model();
  model.particles = soft_pmma();
  return model;
}

}  // namespace afm::test
