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

struct ParticlesNow;

// Content of the wall's centre: the instrument; the plot, in the finale; Millet's analogy; or the instrument at a
// single true scale.
enum class Centerpiece { Instrument, Plot, Analogy, Journey };

// State that moves, shows or hides the objects on the wall. Sessions and the messages of a wall of several machines
// contain every described field except those listed in DescribedWall.*.
struct WallState {
  std::optional<std::size_t> material{};  // index of the sample on the stage; empty: none yet
  scene::Tip tip{};
  scene::Swing swing{};      // swing of a lever in tapping mode; zero otherwise
  bool stroboscope = false;  // true: slow-motion view of the lever within its swing
  double strobe_turns = 0;   // position in that slow swing, 0 to 1 from its lowest point
  scene::SurfacePoint surface{};
  double release_z_m = 0;  // release height with the tip's current parameters; 0: with the material's own
  std::optional<std::size_t> hovered{};
  std::optional<input::WandState> wand{};
  Centerpiece centerpiece = Centerpiece::Instrument;
  double journey_orders = 0;   // used for Centerpiece::Journey; see exhibit/journey.h
  double fade = 0;             // dissolved fraction of the picture, 0 to 1
  glm::dmat4 navigation{1.0};  // room from room: motion, rotation and scaling of sample and instrument by the user
  std::optional<JumpCue> cue{};
  bool false_colours = false;  // true: sample coloured by its heights; the image of a scan has its own colours
  bool scan = false;           // true: running scan, whose panel replaces the curve
  // scan line from left to right, at the height of the highest place below it; sample's frame, metres
  std::optional<std::array<glm::dvec3, 2>> scan_line{};
  const ParticlesNow* particles = nullptr;  // particles, whose panel replaces the sample's data; may be null
};

template <class Visit, scene::RecordOf<WallState>... Record>
constexpr void for_each_field(Visit&& visit, Record&... wall) {
  visit("material", wall.material...);
  visit("tip", wall.tip...);
  visit("swing", wall.swing...);
  visit("stroboscope", wall.stroboscope...);
  visit("strobe_turns", wall.strobe_turns...);
  visit("surface", wall.surface...);
  visit("release_z_m", wall.release_z_m...);
  visit("hovered", wall.hovered...);
  visit("wand", wall.wand...);
  visit("centerpiece", wall.centerpiece...);
  visit("journey_orders", wall.journey_orders...);
  visit("fade", wall.fade...);
  visit("navigation", wall.navigation...);
  visit("cue", wall.cue...);
  visit("false_colours", wall.false_colours...);
  visit("scan", wall.scan...);
  visit("scan_line", wall.scan_line...);
  visit("particles", wall.particles...);
}
static_assert(scene::all_fields_described<WallState>());

}  // namespace afm::exhibit
