// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "input/simulated_wand.h"
#include "scene/shared/tip_blocks.h"

namespace afm::input {

// Path of the hand, heights above the contact point along the sample's normal (haptics/scaling.h: the tip lets go at 50
// mm, where it tears at the hand with 2 N, so the aim must lie well above).
struct HandPath {
  double lift_m = 0.070;
  double push_m = -0.018;
  double speed_m_per_s = 0.030;  // mean, along each stroke
};

// Does with the wand and the hand what a visitor does (section 5 of the paper), one material at a time, and goes on
// only when what it waits for has really happened: the material is in the servo, the force is enabled, the tip is
// attached, the tip is free again. It chooses nothing itself; its ray and its button do. One thread.
class SimulatedPerson {
 public:
  enum class Step { PointAtSwatch, PressSelect, Lift, PressTurnOn, MoveDown, MoveUp, Rest, Done };

  // `normal`: outward normal of the sample, unit, device frame (parallel to the room's).
  SimulatedPerson(const glm::dvec3& wand_grip_m, const glm::dvec3& normal, const HandPath& path);

  // Starts the procedure for the swatch at `swatch_m`; `material` is what the servo must report once it is chosen.
  void begin(const glm::dvec3& swatch_m, std::int32_t material, std::int64_t now_ns);

  // The same on the material that is under the tip already: its parameters have changed.
  void begin_again(std::int64_t now_ns);

  // Once a frame, with the newest state of the tip.
  void update(std::int64_t now_ns, const scene::TipState& tip);

  // After the sample has been turned.
  void set_normal(const glm::dvec3& normal) { normal_ = normal; }

  Step step() const { return step_; }
  std::int32_t material() const { return material_; }  // of the procedure; -1 before the first
  WandState wand(std::int64_t now_ns) const { return wand_.state(now_ns); }
  const scene::HandScript& hand() const { return hand_; }

  // Number of times in this procedure that the force was removed in mid-stroke, which required a new start with a lift.
  int restarts() const { return restarts_; }

  // Event that is being waited for, for the message if it does not occur; and the start of the wait.
  std::string waiting_for() const;
  double seconds_in_step(std::int64_t now_ns) const;

 private:
  void enter(Step step, std::int64_t now_ns);
  void lift_again(std::int64_t now_ns);
  void move_hand(double height_m, double seconds);
  double stroke_seconds() const;

  SimulatedWand wand_;
  glm::dvec3 normal_;
  HandPath path_;
  scene::HandScript hand_;
  std::int32_t material_ = -1;
  Step step_ = Step::Done;
  int restarts_ = 0;
  std::int64_t step_start_ns_ = 0;
  std::int64_t button_change_ns_ = 0;
};

}  // namespace afm::input
