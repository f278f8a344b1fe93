// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "core/enumerators.h"
#include "scene/shared/particle_blocks.h"

namespace afm::scene {

// PushTool is the use of the tip among particles. Push: it lets go of what it touched. Grip: it holds spheres of every
// species with a tip_adhesion, or those that the set names. OfSet: the one of the two that the set is made for.
struct PushToolText {
  PushTool tool;
  const char* word;     // name in the log
  const char* meaning;  // text for people
};
inline constexpr std::array kPushTools{PushToolText{PushTool::OfSet, "of the set", "as the particle file has it"},
                                       PushToolText{PushTool::Push, "push", "the tip lets go of what it touched"},
                                       PushToolText{PushTool::Grip, "grip", "the tip holds what it touched"}};
static_assert(core::has_row_for_each(kPushTools, &PushToolText::tool));

constexpr const PushToolText& text_of(PushTool tool) { return kPushTools[core::index_of(tool)]; }

// Push or Grip: the tool that a setup is made for.
PushTool own_tool(const physics::PushSetup& setup) noexcept;

// True if the tip holds spheres of a species with this tool.
bool sticks_with(PushTool tool, const physics::PushSetup& setup, std::size_t species) noexcept;

// Changes setup or particles to those for this tool; OfSet and their own tool leave them as they are.
void hold(PushTool tool, physics::PushSetup& setup) noexcept;
void hold(PushTool tool, SharedParticles& particles);

// Reason why a tool cannot be chosen among valid particles.
struct ToolRefusal {
  enum class Why { Marks, NoAdhesion, Picture, Lever };
  Why why = Why::Marks;
  std::string text;
};

// Nothing if it can. A device may still be too weak for it.
std::optional<ToolRefusal> tool_refusal(const SharedParticles& particles, PushTool tool);

}  // namespace afm::scene
