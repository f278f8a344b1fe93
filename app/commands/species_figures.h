// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace afm::scene {
struct ParticleSet;
}

namespace afm::app {

// Figures of a species of a set that a user needs before a push: thresholds, gentle load, softest lever, aim, speed. As
// lines of text, and as JSON with the unit in each key.
std::string species_figures_text(const scene::ParticleSet& set, std::size_t species);
nlohmann::json species_figures_json(const scene::ParticleSet& set, std::size_t species);

}  // namespace afm::app
