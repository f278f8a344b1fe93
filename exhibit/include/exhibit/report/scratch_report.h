// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "physics/units.h"
#include "scene/samples/sourced_value.h"

namespace afm::scene {
struct ParticleSet;
struct ScratchRun;
}  // namespace afm::scene

namespace afm::exhibit {

// Sources as JSON, in the form of `touchafm particles`.
nlohmann::json sources_json(std::span<const scene::SourcedValue> sources);

// Effects of a scripted tip on a soft sample, as lines of text and as JSON with the unit in each key; both begin with
// the figures of the sample under the largest load of the hand. `set` was played at `rate`.
std::string scratch_text(const scene::ParticleSet& set, const scene::ScratchRun& run, physics::Frequency rate);
std::string scratch_json(const scene::ParticleSet& set, const scene::ScratchRun& run, physics::Frequency rate);

}  // namespace afm::exhibit
