// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <glm/geometric.hpp>

#include "governor_bench.h"
#include "haptics/safety.h"

// Response of the governor to a late tick: the hand has moved meanwhile, and the model requests another force.
namespace late_tick_test {

using namespace afm::haptics;
using afm::scene::FaultCode;
using afm::scene::ServoState;

// The model requests another force after the pause; the output changes gradually to it.
TEST_F(Governor, GlidesAfterALateTick) {
  hold(1.0);
  input_.wanted_force_n = glm::dvec3(0.0, -2.0, 0.0);
  EXPECT_NEAR(step(5 * kPeriodNs), 1.1, kRounding);
  EXPECT_NEAR(step(), 1.2, kRounding);
  EXPECT_EQ(governor_.state(), ServoState::Running);
}

TEST_F(Governor, DisarmsAfterAPauseOfMoreThan20Ms) {
  for (const std::int64_t pause_ns : {50'000'000, 500'000'000}) {
    restart();
    hold(kCapN);
    const double before_n = glm::length(force_n_);
    EXPECT_GE(step(pause_ns), before_n - SafetyGovernor::kSlewNPerS * 1e-3 - kRounding);
    EXPECT_LE(ticks_to_zero(), 20);
    EXPECT_EQ(governor_.state(), ServoState::Disarmed);
    EXPECT_EQ(governor_.fault(), FaultCode::LateTick);
  }
}

TEST_F(Governor, StaysRunningAfterAPauseOf20Ms) {
  hold(1.0);
  step(20'000'000);
  EXPECT_EQ(governor_.state(), ServoState::Running);
}

// The time that the servo slept through is no time in which the force rose.
TEST_F(Governor, IsNotArmedSoonerByLateTicks) {
  lift();
  press();
  input_.wanted_force_n = glm::dvec3(0.0, -1.0, 0.0);
  const double begun_n = step();
  for (int i = 0; i < 10; ++i) step(20'000'000);
  EXPECT_EQ(governor_.state(), ServoState::Arming);
  EXPECT_NEAR(glm::length(force_n_) - begun_n, 10.0 * 1e-3 / 0.5, kRounding);
}

// The glide after a late tick would draw a quick fade out to more than twice its time.
TEST_F(Governor, EndsAFadeInItsTimeThoughATickInItIsLate) {
  hold(kCapN);
  input_.renderer = RendererLink::Died;
  steps(3);
  step(10'000'000);
  EXPECT_LE(ticks_to_zero(), 8);
  EXPECT_EQ(governor_.fault(), FaultCode::RendererDied);
}

}  // namespace late_tick_test
