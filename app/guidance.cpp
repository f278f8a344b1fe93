// SPDX-License-Identifier: Apache-2.0
#include "app/guidance.h"

#include "app/live_servo.h"
#include "haptics/safety.h"

namespace afm::app {

namespace {

// Where the servo accepts Turn-On.
bool is_lifted(const scene::TipState& tip) {
  return tip.phase == scene::ContactPhase::Free &&
         (tip.z_m - tip.release_z_m) * tip.hand_m_per_m >= haptics::SafetyGovernor::kArmingMarginM;
}

std::string running(const scene::TipState& tip, bool ascending, int cycles) {
  if (tip.phase == scene::ContactPhase::Attached) {
    if (ascending) return "Move up until it lets go";
    return tip.z_m > 0.0 ? "Snapped in: press on until the beam bends up" : "Pressed: now move up until it lets go";
  }
  if (cycles > 0 && ascending) return "It let go: one full cycle. Go down again, or choose another sample";
  return "Move down until the tip snaps in";
}

}  // namespace

std::string guidance(const scene::TipState& tip, bool ascending, int cycles) {
  if (tip.material < 0) return "Point at a sample and press";
  const bool released = tip.servo_state == scene::ServoState::Disarmed && tip.fault != scene::FaultCode::None;
  const std::string why = released ? std::string("Force off: ") + reason(tip.fault) + ". " : std::string();
  switch (tip.servo_state) {
    case scene::ServoState::Arming:
      return "Hold still: the force is coming on";
    case scene::ServoState::Fading:
      return "The force is going off";
    case scene::ServoState::Fault:
      return std::string("Force off: ") + reason(tip.fault) + ". Press Turn-On to go on";
    case scene::ServoState::Running:
      if (tip.phase != scene::ContactPhase::WaitForLift) return running(tip, ascending, cycles);
      break;
    case scene::ServoState::Disarmed:
      if (is_lifted(tip)) {
        return why + (tip.dead_man != 0 ? "Press Turn-On and keep it held" : "Press Turn-On to feel the force");
      }
      break;
  }
  return why + "Lift the tip to its top";
}

}  // namespace afm::app
