// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "haptics/devices/haply_service.h"
#include "live_renderer.h"
#include "scene/shared/shared_blocks.h"

namespace afm::test {

// Newest force that the service received, in newtons.
inline double force_at(const HaplyService& service) {
  const auto forces = service.forces();
  if (forces.empty()) return 0.0;
  return std::hypot(forces.back().x, forces.back().y, forces.back().z);
}

// The paper's procedure by a hand at the service: Turn-On above the sample, down to it, and up until its pull is felt.
// `beat` is called every 2 ms. True if the pull is on the hand; false if the servo released it meanwhile.
inline bool attach(HaplyService& service, scene::RendererSide& side, const std::function<void()>& beat) {
  using Clock = std::chrono::steady_clock;
  constexpr double kStepM = 0.3 * 0.002;  // 0.3 m/s: slower than any limit
  const auto move_to = [&](double up_m) {
    for (double here_m = service.up_m; here_m != up_m; service.up_m = here_m) {
      here_m = here_m < up_m ? std::min(here_m + kStepM, up_m) : std::max(here_m - kStepM, up_m);
      beat();
      wait_a_little();
    }
  };
  using std::chrono::milliseconds;
  // Whether the servo is in one of the wanted states in time; with none a rest.
  const auto reaches = [&](milliseconds patience, auto... wanted) {
    const auto end = Clock::now() + patience;
    while (Clock::now() < end) {
      beat();
      const auto state = side.tip_state();
      if (state && ((state->servo_state == wanted) || ...)) return true;
      wait_a_little();
    }
    return false;
  };
  move_to(0.19);
  // a hand that has just moved is too fast for Turn-On, and pressing has an effect once
  reaches(milliseconds(100));
  service.button = true;
  const bool pressed = reaches(milliseconds(300), scene::ServoState::Arming, scene::ServoState::Running);
  service.button = false;
  if (!pressed || !reaches(milliseconds(1000), scene::ServoState::Running)) return false;
  move_to(0.105);
  move_to(0.14);
  return force_at(service) > 0.3 && holds(side);
}

}  // namespace afm::test
