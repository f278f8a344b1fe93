// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shared/shared_blocks.h"

namespace afm::exhibit {

// Force on the hand, as far as a lesson needs to know it.
enum class HandForce {
  None,
  Changing,  // comes on or fades out
  Reduced,   // on, but weaker than set: the motors are warm
  Full
};

// `share`: share of the set force that is left to the hand. Below kFullShare a person can feel the difference: the just
// noticeable one of forces is 7 % (Pang, Tan and Durlach 1991).
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
