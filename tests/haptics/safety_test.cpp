// SPDX-License-Identifier: Apache-2.0
// Invariant: no force reaches a device except through `SafetyGovernor`: only it can make a `ForceCommand`
#include "haptics/safety.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <type_traits>

#include "governor_bench.h"

namespace safety_test {

using namespace afm::haptics;
using afm::physics::Phase;
using afm::scene::FaultCode;
using afm::scene::ServoState;

// Only the governor can create a force for a hand.
static_assert(!std::is_default_constructible_v<ForceCommand>);
static_assert(!std::is_constructible_v<ForceCommand, glm::dvec3>);
static_assert(!std::is_aggregate_v<ForceCommand>);

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST_F(Governor, GivesNoForceBeforeTurnOn) {
  lift();
  input_.wanted_force_n = glm::dvec3(1.0);
  for (int i = 0; i < 2000; ++i) EXPECT_EQ(step(), 0.0);
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
}

TEST_F(Governor, ArmsInHalfASecond) {
  lift();
  press();
  EXPECT_EQ(governor_.state(), ServoState::Arming);
  steps(498);
  EXPECT_EQ(governor_.state(), ServoState::Arming);
  steps(2);
  EXPECT_EQ(governor_.state(), ServoState::Running);
}

TEST_F(Governor, RampsTheForceWhileArming) {
  lift();
  press();
  input_.wanted_force_n = glm::dvec3(0.0, -1.0, 0.0);
  steps(125);
  EXPECT_NEAR(step(), 0.25, 0.01);
  steps(250);
  EXPECT_NEAR(step(), 0.75, 0.01);
}

struct Obstacle {
  const char* name;
  void (*put)(GovernorInput&);
};

class GovernorWithObstacle : public Governor, public testing::WithParamInterface<Obstacle> {};

TEST_P(GovernorWithObstacle, DoesNotArm) {
  lift();
  GetParam().put(input_);
  step();
  press();
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
  steps(600);
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
}

INSTANTIATE_TEST_SUITE_P(
    Interlock, GovernorWithObstacle,
    testing::Values(Obstacle{"TooLow", [](GovernorInput& i) { i.hand_height_m = 0.0549; }},
                    Obstacle{"Attached", [](GovernorInput& i) { i.phase = Phase::Attached; }},
                    Obstacle{"WaitingForLift", [](GovernorInput& i) { i.phase = Phase::WaitForLift; }},
                    Obstacle{"Force", [](GovernorInput& i) { i.wanted_force_n.y = 0.06; }},
                    Obstacle{"Moving", [](GovernorInput& i) { i.hand_position_m.x += 0.05; }},
                    Obstacle{"NoRenderer", [](GovernorInput& i) { i.renderer = RendererLink::Absent; }},
                    Obstacle{"HungRenderer", [](GovernorInput& i) { i.renderer = RendererLink::Hung; }},
                    Obstacle{"LeavingRenderer", [](GovernorInput& i) { i.renderer = RendererLink::Leaving; }},
                    Obstacle{"DeadRenderer", [](GovernorInput& i) { i.renderer = RendererLink::Died; }}),
    [](const auto& test) { return test.param.name; });

TEST_F(Governor, TakesOnlyTheEdgeOfTheButton) {
  input_.turn_on = true;
  lift();
  steps(600);
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
}

TEST_F(Governor, PassesAForceWithinItsLimitsUnchanged) {
  hold(kCapN);
  EXPECT_EQ(force_n_, glm::dvec3(0.0, -kCapN, 0.0));
  input_.wanted_force_n = glm::dvec3(0.1, -1.9, 0.2);
  step();
  EXPECT_EQ(force_n_, input_.wanted_force_n);
}

TEST_F(Governor, ShortensALongVectorAndKeepsItsDirection) {
  arm();
  input_.wanted_force_n = glm::dvec3(3.0, -4.0, 12.0);
  steps(10);
  EXPECT_NEAR(glm::length(force_n_), kCapN, kRounding);
  EXPECT_NEAR(glm::dot(force_n_, input_.wanted_force_n), kCapN * 13.0, 1e-9);
}

TEST_F(Governor, LimitsTheSlewInBothDirections) {
  arm();
  input_.wanted_force_n = glm::dvec3(0.0, -2.0, 0.0);
  for (const double expected_n : {0.5, 1.0, 1.5, 2.0, 2.0}) EXPECT_NEAR(step(), expected_n, kRounding);
  input_.wanted_force_n = glm::dvec3(0.0);
  for (const double expected_n : {1.5, 1.0, 0.5}) EXPECT_NEAR(step(), expected_n, kRounding);
  EXPECT_EQ(step(), 0.0);
}

TEST_F(Governor, ReleasesWithin20MsOfTheRenderersDeath) {
  hold(kCapN);
  input_.renderer = RendererLink::Died;
  EXPECT_LE(ticks_to_zero(), 20);
  EXPECT_TRUE(dropped_);
  EXPECT_TRUE(governor_.released());
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
  EXPECT_EQ(governor_.fault(), FaultCode::RendererDied);
}

TEST_F(Governor, CutsInTheTickThatHearsStopAndWantsAPressAfterwards) {
  hold(kCapN);
  input_.renderer = RendererLink::Stopped;
  EXPECT_EQ(step(), 0.0);
  EXPECT_TRUE(dropped_);
  EXPECT_EQ(governor_.state(), ServoState::Fault);
  EXPECT_EQ(governor_.fault(), FaultCode::StopPressed);
  input_.renderer = RendererLink::Alive;
  steps(1000);
  EXPECT_EQ(governor_.state(), ServoState::Fault);
  EXPECT_EQ(force_n_, glm::dvec3(0.0));
}

TEST_F(Governor, FadesIn90MsWhenTheRendererHangsOrLeaves) {
  for (const RendererLink link : {RendererLink::Hung, RendererLink::Leaving}) {
    restart();
    hold(kCapN);
    input_.renderer = link;
    EXPECT_NEAR(ticks_to_zero(), 90, 1);
    EXPECT_EQ(governor_.fault(), link == RendererLink::Hung ? FaultCode::RendererHung : FaultCode::None);
  }
}

TEST_F(Governor, HurriesAFadeWhenTheHungRendererDies) {
  hold(kCapN);
  input_.renderer = RendererLink::Hung;
  steps(10);
  input_.renderer = RendererLink::Died;
  EXPECT_LE(ticks_to_zero(), 20);
  EXPECT_EQ(governor_.fault(), FaultCode::RendererDied);
}

TEST_F(Governor, NeedsTurnOnAgainWhenTheRendererComesBack) {
  hold(kCapN);
  input_.renderer = RendererLink::Hung;
  ticks_to_zero();
  input_.renderer = RendererLink::Alive;
  steps(1000);
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
  EXPECT_EQ(governor_.fault(), FaultCode::RendererHung);
  input_.wanted_force_n = glm::dvec3(0.0);
  lift();
  press();
  EXPECT_EQ(governor_.state(), ServoState::Arming);
  EXPECT_EQ(governor_.fault(), FaultCode::None);
}

TEST_F(Governor, CutsToZeroOnWhatIsNotANumber) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    const std::array<double*, 10> numbers{
        &input_.wanted_force_n.x,        &input_.wanted_force_n.y,    &input_.wanted_force_n.z,
        &input_.hand_position_m.x,       &input_.hand_position_m.y,   &input_.hand_position_m.z,
        &input_.hand_height_m,           &input_.law_energy.stored_j, &input_.law_energy.stiffness_n_per_m,
        &input_.law_energy.oscillation_n};
    for (double* number : numbers) {
      restart();
      hold(kCapN);
      *number = bad;
      EXPECT_EQ(step(), 0.0);
      EXPECT_TRUE(dropped_);
      EXPECT_EQ(governor_.state(), ServoState::Fault);
      EXPECT_EQ(governor_.fault(), FaultCode::NotFinite);
    }
  }
}

TEST_F(Governor, LeavesAFaultOnlyByTurnOnAndOnlyOnceItsCauseIsGone) {
  hold(kCapN);
  input_.device_healthy = false;
  EXPECT_EQ(step(), 0.0);
  EXPECT_EQ(governor_.fault(), FaultCode::DeviceError);
  press();
  EXPECT_EQ(governor_.state(), ServoState::Fault);
  input_.device_healthy = true;
  steps(100);
  EXPECT_EQ(governor_.state(), ServoState::Fault);
  press();
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
  input_.wanted_force_n = glm::dvec3(0.0);
  arm();
}

TEST_F(Governor, TripsAtAHandThatFlies) {
  arm();
  input_.wanted_force_n = glm::dvec3(0.0, 1.0, 0.0);
  int ticks = 0;
  while (governor_.state() == ServoState::Running && ++ticks < 100) {
    input_.hand_position_m.y += 2e-3;  // step at 2 m/s
    step();
  }
  EXPECT_EQ(governor_.state(), ServoState::Fault);
  EXPECT_EQ(governor_.fault(), FaultCode::VelocityTrip);
  EXPECT_EQ(glm::length(force_n_), 0.0);
  EXPECT_GE(ticks, 5);
}

TEST_F(Governor, ToleratesTheRecoilOfARelaxedHand) {
  arm();
  for (int i = 0; i < 100; ++i) {
    input_.hand_position_m.y += 0.63e-3;
    step();
  }
  EXPECT_EQ(governor_.state(), ServoState::Running);
}

TEST_F(Governor, BrakesTheHandAfterPullOffAndStopsBrakingAfter100Ms) {
  arm();
  input_.pulled_off = true;
  for (int i = 0; i < 99; ++i) {
    input_.hand_position_m.y += 0.2e-3;  // step at 0.2 m/s upwards
    step();
    input_.pulled_off = false;
  }
  EXPECT_NEAR(force_n_.y, -3.0 * 0.2, 0.01);
  for (int i = 0; i < 5; ++i) {
    input_.hand_position_m.y += 0.2e-3;
    step();
  }
  EXPECT_EQ(force_n_.y, 0.0);
}

TEST_F(Governor, DisarmsWithoutAFaultForAChangeOfMaterial) {
  hold(1.0);
  governor_.disarm();
  EXPECT_LE(ticks_to_zero(), 20);
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
  EXPECT_EQ(governor_.fault(), FaultCode::None);
}

TEST_F(Governor, GivesForceOnlyWhileTurnOnIsHeldWithADeadMan) {
  SafetyLimits limits = kLimits;
  limits.dead_man = true;
  restart(limits);
  lift();
  input_.turn_on = true;
  steps(501);
  ASSERT_EQ(governor_.state(), ServoState::Running);
  input_.wanted_force_n = glm::dvec3(0.0, -kCapN, 0.0);
  input_.phase = Phase::Attached;
  steps(100);
  ASSERT_NEAR(step(), kCapN, kRounding);
  input_.turn_on = false;
  EXPECT_LE(ticks_to_zero(), 21);
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
  EXPECT_EQ(governor_.fault(), FaultCode::DeadManReleased);

  // in the middle of the stroke nothing can arm it
  input_.turn_on = true;
  steps(100);
  EXPECT_EQ(governor_.state(), ServoState::Disarmed);
  input_.turn_on = false;
  input_.wanted_force_n = glm::dvec3(0.0);
  lift();
  input_.turn_on = true;
  steps(501);
  EXPECT_EQ(governor_.state(), ServoState::Running);
}

TEST_F(Governor, DeratesWhatIsHeldForLongToTheContinuousRating) {
  SafetyLimits limits = kLimits;
  limits.continuous_force_n = 0.88;
  restart(limits);
  hold(kCapN);
  double before_n = step();
  for (int i = 0; i < 120'000; ++i) {
    const double force_n = step();
    ASSERT_LE(before_n - force_n, 1e-3);
    before_n = force_n;
  }
  EXPECT_LE(before_n, 0.88);
  EXPECT_EQ(governor_.state(), ServoState::Running);
  EXPECT_GT(governor_.motors().heat(), MotorThermalModel::kWarm);
}

TEST_F(Governor, TakesTheForceAwayFromMotorsThatTheDeviceCallsHot) {
  hold(kCapN);
  input_.motor_heat = 1.0;
  EXPECT_NEAR(ticks_to_zero(), 90, 1);
  EXPECT_EQ(governor_.fault(), FaultCode::MotorsHot);
}

TEST_F(Governor, StopsTheHandAtTheEndOfTheWorkspaceAndLetsGoOutside) {
  SafetyLimits limits = kLimits;
  limits.workspace_min_m = glm::dvec3(-0.080, -0.040, -0.035);
  limits.workspace_max_m = glm::dvec3(0.080, 0.080, 0.035);
  restart(limits);
  arm();
  for (; input_.hand_position_m.x < 0.080; input_.hand_position_m.x += 1e-4) step();
  steps(500);
  EXPECT_NEAR(force_n_.x, -0.75, 0.02);
  EXPECT_EQ(governor_.state(), ServoState::Running);
  for (; input_.hand_position_m.x < 0.0905; input_.hand_position_m.x += 1e-4) step();
  EXPECT_EQ(governor_.state(), ServoState::Fading);
  EXPECT_LE(ticks_to_zero(), 21);
  EXPECT_EQ(governor_.fault(), FaultCode::OutOfWorkspace);
}

TEST_F(Governor, TripsEarlierForADeviceThatToleratesLessSpeed) {
  afm::haptics::DeviceSpec device = omni_like("slow");
  device.max_speed_m_per_s = 0.5;
  EXPECT_DOUBLE_EQ(safety_limits(device, kPeriodNs, kReleaseHeightM, false).trip_speed_m_per_s, 0.4);
  device.max_speed_m_per_s = 10.0;
  EXPECT_DOUBLE_EQ(safety_limits(device, kPeriodNs, kReleaseHeightM, false).trip_speed_m_per_s, 0.8);
}

TEST_F(Governor, ChangesTheForceNoFasterThanTheDeviceAllows) {
  afm::haptics::DeviceSpec device = omni_like("slow");
  device.max_slew_n_per_s = 100.0;
  SafetyLimits limits = safety_limits(device, kPeriodNs, kReleaseHeightM, false);
  EXPECT_DOUBLE_EQ(limits.slew_n_per_s, 80.0);
  restart(limits);
  arm();
  input_.wanted_force_n = glm::dvec3(0.0, -0.5, 0.0);
  EXPECT_NEAR(step(), 0.08, kRounding);
  device.max_slew_n_per_s = 1e4;
  EXPECT_DOUBLE_EQ(safety_limits(device, kPeriodNs, kReleaseHeightM, false).slew_n_per_s, SafetyGovernor::kSlewNPerS);
}

}  // namespace safety_test
