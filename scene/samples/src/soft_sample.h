// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "scene/config/toml_table.h"
#include "scene/samples/particle_set.h"

namespace afm::scene {

class SourcedValues;

// Reads the table [sample] of a particle file, with tip and lever, into a set that so far has only title and medium.
void read_soft_sample(const TomlTable& top, ParticleSet& set);

// Refuses moves that a soft sample of this set cannot bear, or that leave the largest surface. `top` is the root of the
// set's file.
void check_soft_moves(const TomlTable& top, const ParticleSet& set);

// Same for the table [ink]; tip and lever are only needed for a hand.
void read_ink(const TomlTable& top, ParticleSet& set);

// Reads the table [tip], and those springs of the lever that are named. The contact's spring is not used.
void read_marking_tip(const TomlTable& table, ParticleSet& set);
void read_marking_lever(const TomlTable& table, std::span<const std::string_view> springs, ParticleSet& set);

// Adds the sources of these values to those of the set, with a prefix before each key.
void add_sources(ParticleSet& set, std::string_view prefix, SourcedValues& values);

}  // namespace afm::scene
