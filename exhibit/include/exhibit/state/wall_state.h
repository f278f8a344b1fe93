// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "exhibit/state/jump_cue.h"
#include "input/wand.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// The middle of the wall: the instrument; in the finale the plot alone; Millet's analogy of what
// happens; or the instrument at one true scale.
enum class Centerpiece { Instrument, Plot, Analogy, Journey };

// The state that moves, shows or hides the things on the wall. The messages of a wall of several machines and sessions
// carry every described field but those that DescribedWall.* lists.
struct WallState {
  std::optional<std::size_t> material{};  // none: no sample lies on the stage yet
  scene::Tip tip{};
  scene::SurfacePoint surface{};
  double release_z_m = 0;  // with the parameters that the tip has now; 0: those of the material
  std::optional<std::size_t> hovered{};
  std::optional<input::WandState> wand{};
  Centerpiece centerpiece = Centerpiece::Instrument;
  double journey_orders = 0;   // of Centerpiece::Journey, as in exhibit/journey.h
  double fade = 0;             // 0..1: how much of everything has dissolved
  glm::dmat4 navigation{1.0};  // room from room: where sample and instrument have been moved, turned and scaled to
  std::optional<JumpCue> cue{};
  bool scan = false;  // an image is taken: its panel is in the place of the curve
  // its line, from the left to the right, as high as the highest place below it; sample's frame, metres
  std::optional<std::array<glm::dvec3, 2>> scan_line{};
};

template <class Visit, scene::RecordOf<WallState>... Record>
constexpr void for_each_field(Visit&& visit, Record&... wall) {
  visit("material", wall.material...);
  visit("tip", wall.tip...);
  visit("surface", wall.surface...);
  visit("release_z_m", wall.release_z_m...);
  visit("hovered", wall.hovered...);
  visit("wand", wall.wand...);
  visit("centerpiece", wall.centerpiece...);
  visit("journey_orders", wall.journey_orders...);
  visit("fade", wall.fade...);
  visit("navigation", wall.navigation...);
  visit("cue", wall.cue...);
  visit("scan", wall.scan...);
  visit("scan_line", wall.scan_line...);
}
static_assert(scene::all_fields_described<WallState>());

}  // namespace afm::exhibit
