// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/adjusted_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "physics/manipulation/push_figures.h"
#include "physics/quantity_text.h"
#include "scene/shared/push_values.h"

namespace afm::scene {

namespace {

constexpr const char* kChosenHere = "chosen here";
constexpr const char* kLeverChosenHere = "chosen here: the lever of the set, thinner or thicker";

void chosen(std::vector<SourcedValue>& sources, std::string_view key, std::string value, const char* source) {
  const auto at = std::find_if(sources.begin(), sources.end(), [&](const SourcedValue& s) { return s.key == key; });
  if (at == sources.end()) return;
  at->value = std::move(value);
  at->source = source;
  at->estimated = true;
}

}  // namespace

ParticleSet adjusted(const ParticleSet& set, const PushSettings& settings) {
  using physics::format_quantity;
  ParticleSet result = set;
  physics::PushSetup& setup = result.setup;
  adjust(settings, setup);
  if (settings.lever > 0) {
    chosen(result.sources, "lateral_spring", format_quantity(setup.springs.lateral, physics::kStiffnessUnits),
           kLeverChosenHere);
    chosen(result.sources, "normal_spring", format_quantity(setup.springs.normal, physics::kStiffnessUnits),
           kChosenHere);
  }
  if (settings.tip > 0) {
    chosen(result.sources, "tip_radius", format_quantity(setup.tip.radius, physics::kLengthUnits), kChosenHere);
  }
  if (settings.medium == 0) return result;
  const PushMedium& medium = kMediumValues.at(settings.medium);
  result.medium = medium.word;
  result.note.clear();
  const auto text = [](physics::SurfaceEnergy work) { return format_quantity(work, physics::kSurfaceEnergyUnits); };
  for (std::size_t i = 0; i < result.species.size(); ++i) {
    if (physics::turns_flat(setup.species[i])) continue;
    std::vector<SourcedValue>& sources = result.species[i].sources;
    chosen(sources, "work_of_adhesion", text(setup.species[i].contact.work_of_adhesion), medium.source);
    chosen(sources, "tip_adhesion", text(setup.species[i].tip_adhesion), medium.source);
  }
  for (std::size_t i = 0; i < setup.pads.size(); ++i) {
    const std::string key = fmt::format("pad_{}_work_of_adhesion", i + 1);
    chosen(result.sources, key, text(setup.pads[i].work_of_adhesion), medium.source);
  }
  return result;
}

std::vector<PushLimits> push_limits(const ParticleSet& set) {
  std::vector<PushLimits> limits;
  limits.reserve(set.setup.species.size());
  for (const physics::ParticleSpecies& species : set.setup.species) {
    PushLimits of;
    if (!physics::is_island(species)) {
      of.gentle = physics::climbing_load(species, set.setup.tip, set.setup.tip_friction);
    }
    if (!physics::turns_flat(species)) of.softest = physics::softest_lever(species, set.setup.tip);
    limits.push_back(of);
  }
  return limits;
}

void AdjustedSet::use(const PushSettings& settings) {
  if (settings == settings_) return;
  settings_ = settings;
  adjusted_ = std::make_unique<const ParticleSet>(adjusted(set_, settings));
  limits_ = push_limits(*adjusted_);
}

}  // namespace afm::scene
