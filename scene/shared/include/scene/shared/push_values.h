// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/enumerators.h"
#include "physics/manipulation/particle_terms.h"
#include "physics/units.h"
#include "scene/shared/particle_blocks.h"

// Values of the settings that a person changes among particles (PushSettings), and their effects. Any thread.
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

// Normal stiffnesses of a lever; the lateral one changes in proportion, as if the lever were thinner or thicker.
inline constexpr std::array kLeverValues{physics::Stiffness(0.0), physics::Stiffness(0.1), physics::Stiffness(1.0),
                                         physics::Stiffness(10.0), physics::Stiffness(40.0)};

// Radii of the tip's cap.
inline constexpr std::array kTipValues{physics::Length(0.0), physics::Length(5e-9), physics::Length(10e-9),
                                       physics::Length(20e-9), physics::Length(40e-9)};

// A medium changes every work of adhesion: a fraction of it, plus that of a meniscus. Both are estimates, as are the
// unchanged friction and elasticity.
struct PushMedium {
  const char* word;
  const char* source;              // source of the work of adhesion in this medium
  double share = 1.0;              // fraction of the work of adhesion in dry air
  physics::SurfaceEnergy added{};  // 8/3 of a surface tension: 4 pi R gamma = 3/2 pi R W for a wetted sphere
};
inline constexpr std::array kMediumValues{
    PushMedium{"of the set", ""},
    PushMedium{"humid air", "chosen here: as in dry air, and a meniscus of 72 mN/m", 1.0,
               physics::SurfaceEnergy(8.0 / 3.0 * 0.072)},
    PushMedium{"water", "chosen here: a fifth of that in dry air, order of magnitude", 0.2, {}}};

// A setting of PushSettings.
enum class PushSetting : std::uint8_t { Law = 0, Lever = 1, Tip = 2, Medium = 3, Tool = 4, Level = 5 };

struct PushSettingText {
  PushSetting setting;
  const char* name;      // name in the log
  std::uint16_t values;  // number of its values
};
inline constexpr std::array kPushSettings{
    PushSettingText{PushSetting::Law, "friction law", 1 + physics::kParticleLaws.size()},
    PushSettingText{PushSetting::Lever, "lever", kLeverValues.size()},
    PushSettingText{PushSetting::Tip, "tip", kTipValues.size()},
    PushSettingText{PushSetting::Medium, "medium", kMediumValues.size()},
    PushSettingText{PushSetting::Tool, "tool", kPushTools.size()},
    PushSettingText{PushSetting::Level, "level", 2 + kHighestLevel}};
static_assert(core::has_row_for_each(kPushSettings, &PushSettingText::setting));

constexpr const PushSettingText& text_of(PushSetting setting) { return kPushSettings[core::index_of(setting)]; }

// Index of a setting's value, and the settings with another one.
std::uint16_t value_of(const PushSettings& settings, PushSetting setting) noexcept;
PushSettings with(PushSettings settings, PushSetting setting, std::uint16_t value) noexcept;

// True if every setting's index is within its values.
bool is_valid(const PushSettings& settings) noexcept;

// Name of a value in the log: "amontons", "40 N/m".
std::string text_of(PushSetting setting, std::uint16_t value);

// Tool that a setup is made for: Push or Grip.
PushTool own_tool(const physics::PushSetup& setup) noexcept;

// True if the tip holds spheres of a species with this tool.
bool sticks_with(PushTool tool, const physics::PushSetup& setup, std::size_t species) noexcept;

// Applies valid settings to a setup or to particles. Law, medium and tool leave rods and flat islands
// unchanged; a level leaves the setup unchanged. Another level restarts the drift.
void adjust(const PushSettings& settings, physics::PushSetup& setup) noexcept;
void adjust(const PushSettings& settings, SharedParticles& particles);

// True if a value of one setting, with the set's own values for the others, changes anything in it.
bool differs(const SharedParticles& particles, PushSetting setting, std::uint16_t value);

// Settings that turn a set into another one, if there are any.
std::optional<PushSettings> settings_between(const SharedParticles& set, const SharedParticles& other);

// Reason why settings cannot be selected for valid particles.
struct PushRefusal {
  enum class Why { Marks, NoAdhesion, Picture, Lever, NoNumbers };
  Why why = Why::Marks;
  std::string text;
};

// Empty if they can. A device may still be too weak for them.
std::optional<PushRefusal> refusal(const SharedParticles& particles, const PushSettings& settings);

}  // namespace afm::scene
