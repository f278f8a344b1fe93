// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "physics/units.h"

namespace afm::scene {
struct InkRun;
struct ParticleSet;
}  // namespace afm::scene

namespace afm::exhibit {

// Ink left by a scripted tip, for standard output: figures of the ink, and for each move the covered area and
// the predictions of the formulas. The set has ink.
std::string ink_text(const scene::ParticleSet& set, const scene::InkRun& run, physics::Frequency rate);

// Same as one line of JSON with sources, with the unit in each key.
std::string ink_json(const scene::ParticleSet& set, const scene::InkRun& run, physics::Frequency rate);

}  // namespace afm::exhibit
