// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/push_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "physics/manipulation/pushed_particles.h"
#include "physics/quantity_text.h"

namespace afm::scene {

namespace {

using physics::ParticleSpecies;
using physics::turns_flat;

bool can_stick(const ParticleSpecies& species) noexcept {
  return species.tip_adhesion.si > 0.0 && !turns_flat(species);
}

void hold(PushTool tool, physics::PushSetup& setup) noexcept {
  if (tool == PushTool::OfSet || tool == own_tool(setup)) return;
  for (ParticleSpecies& species : setup.species) species.sticks = tool == PushTool::Grip && can_stick(species);
}

// Work of adhesion in the medium; zero stays zero, which means unknown.
physics::SurfaceEnergy adhesion_in(const PushMedium& medium, physics::SurfaceEnergy dry) noexcept {
  return dry.si > 0.0 ? medium.share * dry + medium.added : dry;
}

void immerse(const PushMedium& medium, physics::PushSetup& setup) noexcept {
  for (ParticleSpecies& species : setup.species) {
    if (turns_flat(species)) continue;
    species.contact.work_of_adhesion = adhesion_in(medium, species.contact.work_of_adhesion);
    species.tip_adhesion = adhesion_in(medium, species.tip_adhesion);
  }
  for (physics::StickyPad& pad : setup.pads) pad.work_of_adhesion = adhesion_in(medium, pad.work_of_adhesion);
}

// Numbers that a setting changes.
std::vector<double> numbers_of(const SharedParticles& particles, PushSetting setting) {
  const SharedPusher& pusher = particles.pusher;
  if (setting == PushSetting::Lever) return {pusher.lateral_spring_n_per_m, pusher.normal_spring_n_per_m};
  if (setting == PushSetting::Tip) return {pusher.tip_radius_m};
  if (setting == PushSetting::Level) return {static_cast<double>(particles.level.level)};
  std::vector<double> numbers;
  for (const SharedSpecies& species : particles.species) {
    if (setting == PushSetting::Law) numbers.push_back(static_cast<double>(core::index_of(species.law)));
    if (setting == PushSetting::Tool) numbers.push_back(species.sticks);
    if (setting != PushSetting::Medium) continue;
    numbers.push_back(species.work_of_adhesion_j_per_m2);
    numbers.push_back(species.tip_adhesion_j_per_m2);
  }
  if (setting != PushSetting::Medium) return numbers;
  for (const SharedPad& pad : particles.pads) numbers.push_back(pad.work_of_adhesion_j_per_m2);
  return numbers;
}

std::unique_ptr<SharedParticles> adjusted(const SharedParticles& particles, const PushSettings& settings) {
  auto result = std::make_unique<SharedParticles>(particles);
  adjust(settings, *result);
  return result;
}

// True if the setup lacks a number of a species that another law needs.
bool lacks_numbers(const physics::PushSetup& setup) {
  return std::any_of(setup.species.begin(), setup.species.end(), [](const ParticleSpecies& species) {
    try {
      physics::validate(species);
    } catch (const std::invalid_argument&) {
      return true;
    }
    return false;
  });
}

}  // namespace

std::uint16_t value_of(const PushSettings& settings, PushSetting setting) noexcept {
  switch (setting) {
    case PushSetting::Law:
      return settings.law;
    case PushSetting::Lever:
      return settings.lever;
    case PushSetting::Tip:
      return settings.tip;
    case PushSetting::Medium:
      return settings.medium;
    case PushSetting::Level:
      return settings.level;
    case PushSetting::Tool:
      break;
  }
  return static_cast<std::uint16_t>(settings.tool);
}

PushSettings with(PushSettings settings, PushSetting setting, std::uint16_t value) noexcept {
  switch (setting) {
    case PushSetting::Law:
      settings.law = value;
      break;
    case PushSetting::Lever:
      settings.lever = value;
      break;
    case PushSetting::Tip:
      settings.tip = value;
      break;
    case PushSetting::Medium:
      settings.medium = value;
      break;
    case PushSetting::Level:
      settings.level = value;
      break;
    case PushSetting::Tool:
      settings.tool = static_cast<PushTool>(value);
      break;
  }
  return settings;
}

bool is_valid(const PushSettings& settings) noexcept {
  return std::all_of(kPushSettings.begin(), kPushSettings.end(),
                     [&](const PushSettingText& row) { return value_of(settings, row.setting) < row.values; });
}

std::string text_of(PushSetting setting, std::uint16_t value) {
  if (value == 0) return "of the set";
  switch (setting) {
    case PushSetting::Law:
      return std::string(physics::kParticleLaws.at(value - 1U).word);
    case PushSetting::Lever:
      return physics::format_quantity(kLeverValues.at(value), physics::kStiffnessUnits);
    case PushSetting::Tip:
      return physics::format_quantity(kTipValues.at(value), physics::kLengthUnits);
    case PushSetting::Medium:
      return kMediumValues.at(value).word;
    case PushSetting::Level:
      return fmt::format("{}", value - 1);
    case PushSetting::Tool:
      break;
  }
  return kPushTools.at(value).word;
}

PushTool own_tool(const physics::PushSetup& setup) noexcept {
  const bool sticks = std::any_of(setup.species.begin(), setup.species.end(),
                                  [](const ParticleSpecies& species) { return species.sticks; });
  return sticks ? PushTool::Grip : PushTool::Push;
}

bool sticks_with(PushTool tool, const physics::PushSetup& setup, std::size_t species) noexcept {
  if (tool == PushTool::OfSet || tool == own_tool(setup)) return setup.species[species].sticks;
  return tool == PushTool::Grip && can_stick(setup.species[species]);
}

void adjust(const PushSettings& settings, physics::PushSetup& setup) noexcept {
  hold(settings.tool, setup);
  for (ParticleSpecies& species : setup.species) {
    if (settings.law > 0 && !turns_flat(species)) species.law = physics::kParticleLaws[settings.law - 1U].law;
  }
  if (settings.lever > 0) {
    const physics::Stiffness normal = kLeverValues[settings.lever];
    setup.springs.lateral = (normal / setup.springs.normal) * setup.springs.lateral;
    setup.springs.normal = normal;
  }
  if (settings.tip > 0) setup.tip.radius = kTipValues[settings.tip];
  if (settings.medium > 0) immerse(kMediumValues[settings.medium], setup);
}

void adjust(const PushSettings& settings, SharedParticles& particles) {
  if (particles.count == 0 || settings == PushSettings{}) return;
  if (settings.level > 0 && particles.level.level != settings.level - 1U) {
    particles.level.level = settings.level - 1U;
    particles.level.since_ns = 0;
  }
  physics::PushSetup setup = push_setup(particles);
  adjust(settings, setup);
  particles.pusher.lateral_spring_n_per_m = setup.springs.lateral.si;
  particles.pusher.normal_spring_n_per_m = setup.springs.normal.si;
  particles.pusher.tip_radius_m = setup.tip.radius.si;
  for (std::size_t i = 0; i < setup.species.size(); ++i) {
    const ParticleSpecies& from = setup.species[i];
    SharedSpecies& to = particles.species[i];
    to.law = from.law;
    to.sticks = from.sticks ? 1 : 0;
    to.work_of_adhesion_j_per_m2 = from.contact.work_of_adhesion.si;
    to.tip_adhesion_j_per_m2 = from.tip_adhesion.si;
  }
  std::size_t next = 0;  // next index; a setup contains only existing pads
  for (SharedPad& pad : particles.pads) {
    if (pad.work_of_adhesion_j_per_m2 == 0.0) continue;
    pad.work_of_adhesion_j_per_m2 = setup.pads[next++].work_of_adhesion.si;
  }
}

bool differs(const SharedParticles& particles, PushSetting setting, std::uint16_t value) {
  return numbers_of(*adjusted(particles, with({}, setting, value)), setting) != numbers_of(particles, setting);
}

std::optional<PushSettings> settings_between(const SharedParticles& set, const SharedParticles& other) {
  PushSettings settings;
  for (const PushSettingText& row : kPushSettings) {
    const std::vector<double> wanted = numbers_of(other, row.setting);
    for (std::uint16_t value = 0; value < row.values; ++value) {
      if (numbers_of(*adjusted(set, with({}, row.setting, value)), row.setting) != wanted) continue;
      settings = with(settings, row.setting, value);
      break;
    }
  }
  return *adjusted(set, settings) == other ? std::optional(settings) : std::nullopt;
}

std::optional<PushRefusal> refusal(const SharedParticles& particles, const PushSettings& settings) {
  using Why = PushRefusal::Why;
  if (particles.count == 0) return PushRefusal{Why::Marks, "the tip leaves marks here, and has one tool for that"};
  const auto with_settings = adjusted(particles, settings);
  if (*with_settings == particles) {
    const bool grips = settings.tool == PushTool::Grip && own_tool(push_setup(particles)) != PushTool::Grip;
    return grips ? std::optional(PushRefusal{Why::NoAdhesion, "the set has no spheres with a tip_adhesion"})
                 : std::nullopt;
  }
  physics::PushSetup setup = push_setup(particles);
  if (settings.tool == PushTool::Grip && std::none_of(setup.species.begin(), setup.species.end(), can_stick)) {
    return PushRefusal{Why::NoAdhesion, "the set has no spheres with a tip_adhesion"};
  }
  adjust(settings, setup);
  if (lacks_numbers(setup)) {
    return PushRefusal{Why::NoNumbers, fmt::format("the set has no numbers for the friction law {}",
                                                   text_of(PushSetting::Law, settings.law))};
  }
  try {
    physics::validate(setup);
  } catch (const std::invalid_argument& error) {
    return PushRefusal{Why::Lever, error.what()};
  }
  const std::string no_level = with_settings->level.level > 0 ? why_no_level(*with_settings) : std::string();
  if (no_level.empty()) return std::nullopt;
  return PushRefusal{Why::Picture, fmt::format("no level {}: {}", with_settings->level.level, no_level)};
}

}  // namespace afm::scene
