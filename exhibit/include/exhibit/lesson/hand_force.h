// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shared/shared_blocks.h"

namespace afm::exhibit {

// Force on the hand, in the detail that a lesson needs.
enum class HandForce {
  None,
  Changing,  // force rising or fading
  Reduced,   // weaker force than set, because the motors are warm
  Full
};

// `share`: fraction of the set force that remains on the hand. From kFullShare down a person can feel the difference:
// the just noticeable difference of forces is 7 % (Pang, Tan and Durlach 1991).
inline constexpr double kFullShare = 0.95;
constexpr HandForce hand_force(scene::ServoState state, double share) {
  switch (state) {
    case scene::ServoState::Arming:
    case scene::ServoState::Fading:
      return HandForce::Changing;
    case scene::ServoState::Running:
      return share < kFullShare ? HandForce::Reduced : HandForce::Full;
    case scene::ServoState::Disarmed:
    case scene::ServoState::Fault:
      break;
  }
  return HandForce::None;
}

}  // namespace afm::exhibit
