// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/cycle_curve.h"
#include "app/felt_material.h"
#include "app/wall_scene.h"
#include "render/frame.h"
#include "scene/shared_blocks.h"
#include "scene/wall.h"

namespace afm::app {

// What a finished cycle came to, magnitudes.
struct Felt {
  std::string title;
  std::string law;  // "dmt"
  bool hysteretic = true;
  double f_attr_n = 0, f_ad_n = 0, z_jtc_m = 0, z_joc_m = 0;
};

// One moment of the demonstration, from the live servo or from a session: all that the wall tells.
struct Moment {
  std::optional<std::size_t> material;
  TipView tip;
  double force_n = 0;
  scene::ServoState servo_state = scene::ServoState::Disarmed;
  scene::ContactPhase phase = scene::ContactPhase::WaitForLift;
  bool retracting = false;  // past the deepest push of this cycle
  bool realtime = false;
  double slow_motion = 1;  // as in TipState
  std::optional<JumpCue> cue;
  std::optional<std::size_t> hovered;
  std::optional<input::WandState> wand;
  glm::dmat4 navigation{1.0};  // as in WallScene::Pose
  std::string guidance;
  std::vector<render::DataRow> servo;  // servo_rows()
  // one per material, empty while it has not been felt; the current one is drawn in front
  std::span<const CycleCurve> curves;
  bool analogy = false;                  // Millet's magnet instead of the instrument
  std::optional<double> journey_orders;  // on the journey of scale, as in app/journey.h
  double veil = 0;                       // as in WallScene::Pose
  bool compare_all = false;              // the finale: all curves together, large, and what was felt
  std::vector<Felt> felt;
};

// What WallScene places.
WallScene::Pose pose_of(const Moment& moment);

// The part of the cycle in words, with the letters of the paper's Fig. 2.
std::string stage_of_cycle(const Moment& moment, double z_jtc_m);

// Turns moments into frames for one wall and one viewer.
class FrameBuilder {
 public:
  // `wall_scene` and `materials` must outlive it; what a material is felt with may change between two frames.
  FrameBuilder(const WallScene& wall_scene, const std::vector<FeltMaterial>& materials,
               const std::array<scene::EyeView, 2>& eyes);

  render::FrameState build(const Moment& moment) const;

 private:
  render::ForcePanel force_panel(const Moment& moment) const;
  render::Banner banner(const Moment& moment) const;

  const WallScene* wall_scene_;
  const std::vector<FeltMaterial>* materials_;
  std::array<scene::EyeView, 2> eyes_;
};

// The eyes of the wall's first viewer at his sweet spot, for its first screen.
core::Result<std::array<scene::EyeView, 2>> eyes_at_sweet_spot(const scene::Wall& wall);

// Colours of the materials' curves, by their place in the material file: Okabe & Ito's palette, safe for the
// colour-blind.
glm::vec3 curve_color(std::size_t material);

}  // namespace afm::app
