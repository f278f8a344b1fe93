// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string_view>

#include "scene/shared/shared_blocks.h"

// The three materials of Liu & Peng, Table 1, on a sample whose +z points up, for tests that need no files.
namespace afm::test {

inline scene::SharedContact material(std::string_view name, double spring_constant, double hamaker,
                                     double surface_energy) {
  return {.name = scene::to_name(name),
          .contact = {.tip_radius = physics::Length(50e-9),
                      .spring_constant = physics::Stiffness(spring_constant),
                      .sample_stiffness = physics::Stiffness(std::numeric_limits<double>::infinity()),
                      .hamaker = physics::Energy(hamaker),
                      .mean_surface_energy = physics::SurfaceEnergy(surface_energy)}};
}

inline constexpr std::int32_t kMica = 0, kGold = 1, kSiliconNitride = 2;

inline scene::SharedModel paper_model() {
  scene::SharedModel model;
  model.node_count = 2;
  model.nodes[0].name = scene::to_name("stage");
  model.nodes[0].parent_from_node = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  model.nodes[1].name = scene::to_name("sample");
  model.nodes[1].parent = 0;
  // columns: x, y, z and origin of the sample in the room; z is up
  model.nodes[1].parent_from_node = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 1.5, 0, 1};
  model.sample_node = 1;
  model.material_count = 3;
  model.materials[kMica] = material("mica", 0.1, 24.5e-21, 2.228e-3);
  model.materials[kGold] = material("gold", 0.1, 120e-21, 15.915e-3);
  model.materials[kSiliconNitride] = material("si3n4", 0.036, 10e-21, 0.955e-3);
  return model;
}

}  // namespace afm::test
