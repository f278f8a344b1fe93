// SPDX-License-Identifier: Apache-2.0
#include "input/simulated_person.h"

namespace afm::input {

namespace {

constexpr double kAimSeconds = 0.9;
constexpr double kReadSeconds = 0.5;  // time to look at the target before pressing
constexpr double kPressSeconds = 0.25;
constexpr std::int64_t kButtonNs = 250'000'000;
constexpr double kLiftSeconds = 0.8;
constexpr double kRestSeconds = 0.7;  // time to look at the finished curve

}  // namespace

SimulatedPerson::SimulatedPerson(const glm::dvec3& wand_grip_m, const glm::dvec3& normal, const HandPath& path)
    : wand_(wand_grip_m), normal_(normal), path_(path) {}

void SimulatedPerson::begin(const glm::dvec3& swatch_m, std::int32_t material, std::int64_t now_ns) {
  material_ = material;
  restarts_ = 0;
  wand_.aim_at(swatch_m, kAimSeconds, now_ns);
  enter(Step::PointAtSwatch, now_ns);
}

void SimulatedPerson::begin_again(std::int64_t now_ns) {
  restarts_ = 0;
  move_hand(path_.lift_m, kLiftSeconds);
  enter(Step::Lift, now_ns);
}

void SimulatedPerson::enter(Step step, std::int64_t now_ns) {
  step_ = step;
  step_start_ns_ = now_ns;
}

double SimulatedPerson::seconds_in_step(std::int64_t now_ns) const {
  return static_cast<double>(now_ns - step_start_ns_) * 1e-9;
}

void SimulatedPerson::move_hand(double height_m, double seconds) {
  const glm::dvec3 target = height_m * normal_;
  hand_.target_m = {target.x, target.y, target.z};
  hand_.duration_s = seconds;
  ++hand_.revision;
}

double SimulatedPerson::stroke_seconds() const { return (path_.lift_m - path_.push_m) / path_.speed_m_per_s; }

void SimulatedPerson::lift_again(std::int64_t now_ns) {
  const int before = restarts_;
  begin_again(now_ns);
  restarts_ = before + 1;
}

void SimulatedPerson::update(std::int64_t now_ns, const scene::TipState& tip) {
  const bool path_finished = tip.acknowledged.hand_script == hand_.revision;
  switch (step_) {
    case Step::PointAtSwatch:
      if (wand_.arrived(now_ns) && seconds_in_step(now_ns) > kAimSeconds + kReadSeconds) {
        wand_.press(kPressSeconds, now_ns);
        enter(Step::PressSelect, now_ns);
      }
      break;
    case Step::PressSelect:
      if (tip.material == material_ && seconds_in_step(now_ns) > kPressSeconds) {
        move_hand(path_.lift_m, kLiftSeconds);
        enter(Step::Lift, now_ns);
      } else if (path_finished && tip.phase == physics::Phase::Attached) {
        move_hand(path_.lift_m, stroke_seconds());  // first a lift: an attached tip keeps its material
      }
      break;
    case Step::Lift:
      if (path_finished) {
        hand_.turn_on_pressed = 1;
        button_change_ns_ = now_ns;
        enter(Step::PressTurnOn, now_ns);
      }
      break;
    case Step::PressTurnOn:
      if (tip.servo_state == scene::ServoState::Running) {
        hand_.turn_on_pressed = 0;
        move_hand(path_.push_m, stroke_seconds());
        enter(Step::MoveDown, now_ns);
      } else if ((tip.servo_state == scene::ServoState::Disarmed || tip.servo_state == scene::ServoState::Fault) &&
                 now_ns - button_change_ns_ > kButtonNs) {
        // the hand was still moving, or there was a fault, at the press: release and press again
        hand_.turn_on_pressed = 1 - hand_.turn_on_pressed;
        button_change_ns_ = now_ns;
      }
      break;
    case Step::MoveDown:
      if (tip.servo_state != scene::ServoState::Running) {
        lift_again(now_ns);
      } else if (path_finished && tip.phase == physics::Phase::Attached) {
        move_hand(path_.lift_m, stroke_seconds());
        enter(Step::MoveUp, now_ns);
      }
      break;
    case Step::MoveUp:
      if (tip.servo_state != scene::ServoState::Running) {
        lift_again(now_ns);
      } else if (path_finished && tip.phase == physics::Phase::Free) {
        enter(Step::Rest, now_ns);
      }
      break;
    case Step::Rest:
      if (seconds_in_step(now_ns) > kRestSeconds) enter(Step::Done, now_ns);
      break;
    case Step::Done:
      break;
  }
}

std::string SimulatedPerson::waiting_for() const {
  switch (step_) {
    case Step::PointAtSwatch:
      return "the wand to reach the swatch";
    case Step::PressSelect:
      return "the servo to apply the chosen material";
    case Step::Lift:
      return "the hand to lift the tip";
    case Step::PressTurnOn:
      return "the servo to enable the force";
    case Step::MoveDown:
      return "the tip to jump to contact";
    case Step::MoveUp:
      return "the tip to jump off contact";
    case Step::Rest:
    case Step::Done:
      break;
  }
  return "the next material";
}

}  // namespace afm::input
