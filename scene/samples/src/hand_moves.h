// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "scene/config/toml_table.h"
#include "scene/samples/particle_set.h"

namespace afm::scene {

inline constexpr physics::Length kWidestPlace{1e-4};

// A coordinate from -most to most; others are refused.
physics::Length place(const TomlTable& table, std::string_view key, physics::Length most);

// Reads a place of the lever's base: x, y and z.
physics::LeverBase base(const TomlTable& table);

// Reads a [[move]] that begins at a place; on a soft sample there are no sweeps and no waits.
HandMove read_move(const TomlTable& table, const physics::LeverBase& from, bool soft);

// Refuses a start inside a particle, out of which nothing would push the tip.
void check_start(const TomlTable& start, const ParticleSet& set);

}  // namespace afm::scene
