// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "physics/contact_parameters.h"
#include "scene/config/toml_table.h"
#include "scene/samples/particle_set.h"

// Refusals of particle files in the words of the file: the physics knows rods and islands by the fields of a sphere.
namespace afm::scene {

// Tables of a particle file, which refuse what was read from them.
struct SetTables {
  TomlTable top, tip, lever;
  std::vector<TomlTable> species, particles;
};

// Checks tip, lever and species together, and then the places of the particles.
void check_setup(const ParticleSet& set, const SetTables& tables);
void check_places(const ParticleSet& set, const SetTables& tables);

// Refuses a value of a rod or of an island that the physics has refused.
[[noreturn]] void refuse_rod(const TomlTable& table, const physics::UnphysicalValue& error);
[[noreturn]] void refuse_island(const TomlTable& table, const physics::UnphysicalValue& error, physics::Length height);

// Refuses a place beyond the rectangle of the particles; `what` is the subject of the sentence.
void check_within_field(const TomlTable& table, const ParticleSet& set, const physics::Sideways<physics::Length>& place,
                        std::string_view what);

}  // namespace afm::scene
