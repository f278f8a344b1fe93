// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/push_setting_words.h"

#include <algorithm>

#include "core/enumerators.h"
#include "exhibit/words/phrases.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/quantity_text.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {

using scene::PushSetting;

namespace {

static_assert(after(Phrase::SettingLaw, core::index_of(PushSetting::Medium)) == Phrase::SettingMedium);
static_assert(after(Phrase::ToolPush, 1) == Phrase::ToolGrip);

// Law of the spheres of a set; without spheres, that of the first species.
physics::ParticleLaw own_law(const physics::PushSetup& setup) {
  const auto sphere =
      std::find_if_not(setup.species.begin(), setup.species.end(),
                       [](const physics::ParticleSpecies& species) { return physics::turns_flat(species); });
  if (sphere != setup.species.end()) return sphere->law;
  return setup.species.empty() ? physics::ParticleLaw::Measured : setup.species.front().law;
}

}  // namespace

const std::string& name_of(PushSetting setting, const Phrases& phrases) {
  if (setting == PushSetting::Tool) return phrases[Phrase::ToolName];
  if (setting == PushSetting::Level) return phrases[Phrase::SettingLevel];
  return phrases[after(Phrase::SettingLaw, core::index_of(setting))];
}

std::string value_text(PushSetting setting, std::uint16_t value, const scene::ParticleSet& set) {
  if (value > 0) return scene::text_of(setting, value);
  switch (setting) {
    case PushSetting::Law:
      return std::string(physics::text_of(own_law(set.setup)).word);
    case PushSetting::Lever:
      return physics::format_quantity(set.setup.springs.normal, physics::kStiffnessUnits);
    case PushSetting::Tip:
      return physics::format_quantity(set.setup.tip.radius, physics::kLengthUnits);
    case PushSetting::Medium:
      return set.medium;
    case PushSetting::Level:
      return "as at the start";
    case PushSetting::Tool:
      break;
  }
  return scene::text_of(scene::own_tool(set.setup)).word;
}

std::string value_name(PushSetting setting, std::uint16_t value, const scene::ParticleSet& set,
                       const Phrases& phrases) {
  if (setting == PushSetting::Law) {
    const std::size_t law = value > 0 ? value - 1U : core::index_of(own_law(set.setup));
    return phrases[after(Phrase::PushLawArea, law)];
  }
  if (setting == PushSetting::Tool) {
    const auto tool = value > 0 ? static_cast<scene::PushTool>(value) : scene::own_tool(set.setup);
    return phrases[tool == scene::PushTool::Grip ? Phrase::ToolGrip : Phrase::ToolPush];
  }
  if (setting == PushSetting::Level && value == 0) return phrases[Phrase::SettingLevelOwn];
  const std::string text = value_text(setting, value, set);
  return setting == PushSetting::Medium ? phrases.word(text) : phrases.number(text);
}

std::vector<std::string> changed_settings(const scene::PushSettings& settings, const scene::ParticleSet& set,
                                          const Phrases& phrases) {
  std::vector<std::string> changed;
  changed.reserve(scene::kPushSettings.size());
  for (const scene::PushSettingText& row : scene::kPushSettings) {
    const std::uint16_t value = scene::value_of(settings, row.setting);
    if (value == 0 || row.setting == PushSetting::Tool) continue;
    const bool law = row.setting == PushSetting::Law;  // short
    changed.push_back(
        name_of(row.setting, phrases) + " " +
        (law ? phrases.word(value_text(row.setting, value, set)) : value_name(row.setting, value, set, phrases)));
  }
  return changed;
}

}  // namespace afm::exhibit
