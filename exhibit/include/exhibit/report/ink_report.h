// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "physics/units.h"

namespace afm::scene {
struct InkRun;
struct ParticleSet;
}  // namespace afm::scene

namespace afm::exhibit {

// Ink that a scripted tip has left, for standard output: figures of the ink, and each move with what it has covered and
// what the formulas say. The set has ink.
std::string ink_text(const scene::ParticleSet& set, const scene::InkRun& run, physics::Frequency rate);

// The same as JSON with sources, in one line, with the unit in each key.
std::string ink_json(const scene::ParticleSet& set, const scene::InkRun& run, physics::Frequency rate);

}  // namespace afm::exhibit
