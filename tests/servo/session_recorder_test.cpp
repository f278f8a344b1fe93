// SPDX-License-Identifier: Apache-2.0
#include "servo/session_recorder.h"

#include <gtest/gtest.h>

namespace afm::servo {
namespace {

using physics::Phase;
using scene::ServoState;
using scene::TipSample;
using scene::TipState;

constexpr double kRelease_m = 20e-9;

TipState state() {
  TipState tip;
  tip.material = 1;
  tip.active.release_z_m = kRelease_m;
  return tip;
}

TipSample sample(Phase phase, double z_m) {
  TipSample s;
  s.material = 1;
  s.servo_state = ServoState::Fault;
  s.phase = phase;
  s.tip.z_m = z_m;
  return s;
}

// A demonstration that a late tick released twice did not replay: its session began in the tick that dropped the force,
// in which the tip was free below Z_joc. A servo that starts there waits for the tip to be lifted.
TEST(SessionRecorder, BeginsWhereThePhaseFollowsFromThePlace) {
  EXPECT_FALSE(can_begin_with(sample(Phase::Free, 0.5 * kRelease_m), state(), false));
  EXPECT_FALSE(can_begin_with(sample(Phase::Free, kRelease_m), state(), false));
  EXPECT_TRUE(can_begin_with(sample(Phase::Free, 1.1 * kRelease_m), state(), false));
  EXPECT_TRUE(can_begin_with(sample(Phase::WaitForLift, 0.5 * kRelease_m), state(), false));
  EXPECT_FALSE(can_begin_with(sample(Phase::Attached, 0.5 * kRelease_m), state(), false));
}

TEST(SessionRecorder, BeginsWithALeverThatSwingsOnlyBeforeItIsLifted) {
  EXPECT_FALSE(can_begin_with(sample(Phase::Free, 1.1 * kRelease_m), state(), true));
  EXPECT_TRUE(can_begin_with(sample(Phase::WaitForLift, 0.5 * kRelease_m), state(), true));
}

TEST(SessionRecorder, BeginsWithoutForceAlone) {
  TipSample pulled = sample(Phase::WaitForLift, 0.0);
  pulled.hand_force_n = 0.1;
  EXPECT_FALSE(can_begin_with(pulled, state(), false));
  TipSample running = sample(Phase::WaitForLift, 0.0);
  running.servo_state = ServoState::Running;
  EXPECT_FALSE(can_begin_with(running, state(), false));
}

// Where Z_joc lies is known of the contact of the newest state alone.
TEST(SessionRecorder, WaitsForTheStateOfTheSampleItIsGiven) {
  TipState other = state();
  other.material = 2;
  EXPECT_FALSE(can_begin_with(sample(Phase::Free, 1.1 * kRelease_m), other, false));
}

}  // namespace
}  // namespace afm::servo
