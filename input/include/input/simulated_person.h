// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "input/simulated_wand.h"
#include "scene/shared/tip_blocks.h"

namespace afm::input {

// Path of the hand, as heights above the contact point along the sample's normal. The tip detaches at 50 mm, where it
// pulls the hand with 2 N (haptics/scaling.h), so the target must be well above.
struct HandPath {
  double lift_m = 0.070;
  double push_m = -0.018;
  double speed_m_per_s = 0.030;  // mean speed along each stroke
};

// Handles the wand and the device like a visitor (section 5 of the paper), one material at a time. Continues only when
// the expected event has really occurred: the material is in the servo, the force is enabled, the tip is attached, the
// tip is free again. It selects only through its ray and its button. One thread.
class SimulatedPerson {
 public:
  enum class Step { PointAtSwatch, PressSelect, Lift, PressTurnOn, MoveDown, MoveUp, Rest, Done };

  // `normal`: outward normal of the sample, unit, device frame (parallel to the room's).
  SimulatedPerson(const glm::dvec3& wand_grip_m, const glm::dvec3& normal, const HandPath& path);

  // Starts the procedure for the swatch at `swatch_m`; `material` is the number that the servo must report after the
  // selection.
  void begin(const glm::dvec3& swatch_m, std::int32_t material, std::int64_t now_ns);

  // Repeats the procedure with the current material, after a change of its parameters.
  void begin_again(std::int64_t now_ns);

  // Call once per frame, with the newest state of the tip.
  void update(std::int64_t now_ns, const scene::TipState& tip);

  // Call after turning the sample.
  void set_normal(const glm::dvec3& normal) { normal_ = normal; }

  Step step() const { return step_; }
  std::int32_t material() const { return material_; }  // material of the procedure; -1 before the first one
  WandState wand(std::int64_t now_ns) const { return wand_.state(now_ns); }
  const scene::HandScript& hand() const { return hand_; }

  // Number of restarts in this procedure: the force was removed in mid-stroke, and the hand had to lift and start
  // again.
  int restarts() const { return restarts_; }

  // Awaited event, for the message if it does not occur; and the start of the wait.
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
