// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/push_tools.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "physics/manipulation/pushed_particles.h"
#include "scene/shared/particle_blocks.h"

namespace afm::scene {

namespace {

bool can_stick(const physics::ParticleSpecies& species) noexcept {
  return species.tip_adhesion.si > 0.0 && !physics::turns_flat(species);
}

}  // namespace

PushTool own_tool(const physics::PushSetup& setup) noexcept {
  const bool sticks = std::any_of(setup.species.begin(), setup.species.end(),
                                  [](const physics::ParticleSpecies& species) { return species.sticks; });
  return sticks ? PushTool::Grip : PushTool::Push;
}

bool sticks_with(PushTool tool, const physics::PushSetup& setup, std::size_t species) noexcept {
  if (tool == PushTool::OfSet || tool == own_tool(setup)) return setup.species[species].sticks;
  return tool == PushTool::Grip && can_stick(setup.species[species]);
}

void hold(PushTool tool, physics::PushSetup& setup) noexcept {
  if (tool == PushTool::OfSet || tool == own_tool(setup)) return;
  for (physics::ParticleSpecies& species : setup.species) species.sticks = tool == PushTool::Grip && can_stick(species);
}

void hold(PushTool tool, SharedParticles& particles) {
  const physics::PushSetup setup = push_setup(particles);
  for (std::size_t i = 0; i < setup.species.size(); ++i) {
    particles.species[i].sticks = sticks_with(tool, setup, i) ? 1 : 0;
  }
}

std::optional<ToolRefusal> tool_refusal(const SharedParticles& particles, PushTool tool) {
  using Why = ToolRefusal::Why;
  if (particles.count == 0) return ToolRefusal{Why::Marks, "the tip leaves marks here, and has one tool for that"};
  physics::PushSetup setup = push_setup(particles);
  if (tool == PushTool::OfSet || tool == own_tool(setup)) return std::nullopt;
  if (particles.level.level > 0) {
    return ToolRefusal{Why::Picture, fmt::format("at level {} the picture is computed for the tool of the set",
                                                 particles.level.level)};
  }
  if (tool == PushTool::Grip && std::none_of(setup.species.begin(), setup.species.end(), can_stick)) {
    return ToolRefusal{Why::NoAdhesion, "the set has no spheres with a tip_adhesion"};
  }
  hold(tool, setup);
  try {
    physics::validate(setup);
  } catch (const std::invalid_argument& error) {
    return ToolRefusal{Why::Lever, error.what()};
  }
  return std::nullopt;
}

}  // namespace afm::scene
