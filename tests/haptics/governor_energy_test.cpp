// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <glm/vec3.hpp>

#include "governor_bench.h"
#include "haptics/safety.h"

// Energies booked by the governor: the hand's, and that of one visit to the sample.
namespace governor_energy_test {

using namespace afm::haptics;
using afm::physics::Phase;
using afm::scene::ServoState;

constexpr double kRiseJ = 5e-5;

class GovernorEnergy : public Governor {
 protected:
  // On the sample with a law that holds kRiseJ more than in the tick before, though the hand rests.
  void gain_energy() {
    input_.law_energy.stored_j += kRiseJ;
    step();
  }
  void hold_passively() {
    hold(0.5);
    input_.law_energy.stiffness_n_per_m = 0.0;
    step();
    ASSERT_EQ(governor_.observer().excess_j(), 0.0);
  }
};

TEST_F(GovernorEnergy, BooksWhatTheHandDidNotPutIn) {
  hold_passively();
  gain_energy();
  EXPECT_NEAR(governor_.observer().excess_j(), kRiseJ, 1e-12);
}

TEST_F(GovernorEnergy, DoesNotBookTheWorkOfAWandThatMovesTheSample) {
  hold_passively();
  input_.sample_moved = true;
  for (int i = 0; i < 10; ++i) gain_energy();
  EXPECT_EQ(governor_.observer().excess_j(), 0.0);
  EXPECT_EQ(governor_.state(), ServoState::Running);
}

TEST_F(GovernorEnergy, BeginsAnewHighAboveTheSample) {
  hold_passively();
  gain_energy();
  ASSERT_GT(governor_.observer().excess_j(), 0.0);
  input_.wanted_force_n = glm::dvec3(0.0);
  input_.phase = Phase::Free;
  step();
  EXPECT_GT(governor_.observer().excess_j(), 0.0) << "not yet high enough";
  input_.hand_height_m = kReleaseHeightM + SafetyGovernor::kArmingMarginM;
  step();
  EXPECT_EQ(governor_.observer().excess_j(), 0.0);
  EXPECT_EQ(governor_.state(), ServoState::Running);
}

}  // namespace governor_energy_test
