// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace afm::scene {
struct ParticleSet;
struct PushScript;
struct ScriptedPush;
}  // namespace afm::scene

namespace afm::app {

// Figures of a species of a set that a user needs before a push: thresholds, gentle load, softest lever, aim, speed. As
// lines of text, and as JSON with the unit in each key.
std::string species_figures_text(const scene::ParticleSet& set, std::size_t species);
nlohmann::json species_figures_json(const scene::ParticleSet& set, std::size_t species);

// Measured, computed and stale parts of the picture after the moves, and the result of each second look; empty or null
// without a picture.
std::string picture_text(const scene::PushScript& script, const scene::ScriptedPush& played);
nlohmann::json picture_json(const scene::PushScript& script, const scene::ScriptedPush& played);

}  // namespace afm::app
