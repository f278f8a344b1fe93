// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/shared/push_values.h"

namespace afm::scene {
struct ParticleSet;
}

namespace afm::exhibit {

class Phrases;

// Name of a setting among particles on the wall.
const std::string& name_of(scene::PushSetting setting, const Phrases& phrases);

// Name of one of its values: "40 N/m". 0 is that of the set, which has its own settings.
std::string value_name(scene::PushSetting setting, std::uint16_t value, const scene::ParticleSet& set,
                       const Phrases& phrases);

// The same in English, as in particle files, for the log.
std::string value_text(scene::PushSetting setting, std::uint16_t value, const scene::ParticleSet& set);

// Those that are not as in the set, with their values: "Lever 40 N/m", "Medium water". The tool is left out.
std::vector<std::string> changed_settings(const scene::PushSettings& settings, const scene::ParticleSet& set,
                                          const Phrases& phrases);

}  // namespace afm::exhibit
