// SPDX-License-Identifier: Apache-2.0
#include "app/guidance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace afm::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// Mica under the tip at this height of the hand.
scene::TipState tip(scene::ServoState state, scene::ContactPhase phase, double hand_height_m) {
  constexpr double kHandMPerM = 0.05 / 14e-9;
  scene::TipState tip;
  tip.material = 0;
  tip.servo_state = state;
  tip.phase = phase;
  tip.hand_m_per_m = kHandMPerM;
  tip.z_m = hand_height_m / kHandMPerM;
  tip.release_z_m = 0.05 / kHandMPerM;
  return tip;
}

TEST(Guidance, LeadsThroughTheProcedureByWhatHasHappened) {
  using State = scene::ServoState;
  using Phase = scene::ContactPhase;
  EXPECT_THAT(guidance({}, false, 0), HasSubstr("Point at a sample"));
  EXPECT_THAT(guidance(tip(State::Disarmed, Phase::WaitForLift, 0.03), false, 0), HasSubstr("Lift"));
  EXPECT_THAT(guidance(tip(State::Disarmed, Phase::Free, 0.051), true, 0), HasSubstr("Lift"));
  EXPECT_THAT(guidance(tip(State::Disarmed, Phase::Free, 0.060), true, 0), HasSubstr("Press Turn-On"));
  EXPECT_THAT(guidance(tip(State::Arming, Phase::Free, 0.060), true, 0), HasSubstr("Hold still"));
  EXPECT_THAT(guidance(tip(State::Running, Phase::Free, 0.040), false, 0), HasSubstr("Move down"));
  EXPECT_THAT(guidance(tip(State::Running, Phase::Attached, 0.005), false, 0), HasSubstr("press on"));
  EXPECT_THAT(guidance(tip(State::Running, Phase::Attached, -0.010), false, 0), HasSubstr("move up"));
  EXPECT_THAT(guidance(tip(State::Running, Phase::Attached, 0.030), true, 0), HasSubstr("Move up"));
  EXPECT_THAT(guidance(tip(State::Running, Phase::Free, 0.060), true, 1), HasSubstr("let go"));
  EXPECT_THAT(guidance(tip(State::Running, Phase::Free, 0.060), false, 1), HasSubstr("Move down"));
}

TEST(Guidance, SaysWhyTheForceWasTakenAway) {
  scene::TipState fault = tip(scene::ServoState::Fault, scene::ContactPhase::WaitForLift, 0.0);
  fault.fault = scene::FaultCode::VelocityTrip;
  EXPECT_THAT(guidance(fault, false, 0), HasSubstr("faster than is safe"));

  scene::TipState released = tip(scene::ServoState::Disarmed, scene::ContactPhase::Free, 0.060);
  released.fault = scene::FaultCode::LateTick;
  EXPECT_THAT(guidance(released, true, 0), AllOf(HasSubstr("20 ms late"), HasSubstr("Press Turn-On")));
}

TEST(Guidance, AsksToHoldTheButtonThatTheForceHangsOn) {
  scene::TipState lifted = tip(scene::ServoState::Disarmed, scene::ContactPhase::Free, 0.060);
  lifted.dead_man = 1;
  EXPECT_THAT(guidance(lifted, true, 0), HasSubstr("keep it held"));
}

}  // namespace
}  // namespace afm::app
