// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "input/wand.h"
#include "scene/shared/tip_blocks.h"

namespace afm::input {

// True if the wand must not move the scene: the tip is in contact, or a force acts on the hand. Hand and picture would
// otherwise separate.
bool navigation_locked(const scene::TipState& tip);

// Transform of the scene by a wand: a similarity of the room. `pivot_m` is the centre of the scene, about which sticks
// and caps turn and scale it. Pure: depends only on its inputs, not on the frame rate. One thread.
//
// - Grab held, with a pointed wand: the scene follows the wand rigidly; a wand brought back restores it exactly.
// - Grab held, with a cap: it flies and turns the scene. Sticks of other wands do so at any time.
// - Scale held: enlarges when pulled towards the user, or upwards; about the hand if it is tracked, else about the
//   centre.
// - Home: back to the initial transform.
class Navigation {
 public:
  explicit Navigation(const glm::dvec3& pivot_m) : pivot_m_(pivot_m) {}

  // Call once per frame, `frame_s` >= 0 after the previous frame. While `locked`, nothing moves; a held button then
  // continues from the wand's current pose.
  void update(const WandState& wand, double frame_s, bool locked);

  void home();

  glm::dmat4 room_from_scene() const;
  double scale() const { return scale_; }

  static constexpr double kSmallestScale = 0.05;
  static constexpr double kLargestScale = 20.0;
  static constexpr double kFarthestM = 10.0;  // largest distance that a stick flies the scene

 private:
  void follow_grab(const WandState& wand);
  void follow_scale(const WandState& wand, double frame_s);
  void scale_about(const glm::dvec3& center_m, double scale, const glm::dvec3& from_m);
  void fly(const WandState& wand, double frame_s);
  void let_go();

  glm::dvec3 pivot_m_;
  // room = pivot + shift + scale * turn * (scene - pivot)
  glm::dvec3 shift_m_{0.0};
  glm::dquat turn_{1.0, 0.0, 0.0, 0.0};
  double scale_ = 1.0;

  struct Grab {
    glm::dquat wand_from_scene;
    glm::dvec3 middle_in_wand_m;
  };
  std::optional<Grab> grab_;
  struct Scaling {
    glm::dvec3 wand_m;
    glm::dvec3 along;  // pointing direction of the wand
    glm::dvec3 middle_m;
    double scale;
  };
  std::optional<Scaling> scaling_;
  glm::dvec3 velocity_m_per_s_{0.0};
  glm::dvec3 turn_rate_rad_per_s_{0.0};
  bool home_was_pressed_ = false;
};

}  // namespace afm::input
