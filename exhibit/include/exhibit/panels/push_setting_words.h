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

// Name of one of its values: "40 N/m". Value 0 is that of the set.
std::string value_name(scene::PushSetting setting, std::uint16_t value, const scene::ParticleSet& set,
                       const Phrases& phrases);

// Same in English, as in particle files, for the log.
std::string value_text(scene::PushSetting setting, std::uint16_t value, const scene::ParticleSet& set);

// Settings that differ from those of the set, with their values: "Lever 40 N/m", "Medium water". Omits the tool.
std::vector<std::string> changed_settings(const scene::PushSettings& settings, const scene::ParticleSet& set,
                                          const Phrases& phrases);

}  // namespace afm::exhibit
