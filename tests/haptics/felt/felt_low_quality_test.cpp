// SPDX-License-Identifier: Apache-2.0
// A hand on a lever that taps in a liquid, where the swing follows a table by direct integration.
#include <gtest/gtest.h>

#include <string>

#include "felt/tapping_hand.h"
#include "servo_bench.h"
#include "support/deep.h"

namespace afm::haptics {
namespace felt_low_quality_test {

using test::tapped_mica;
using test::TappingHand;

class FeltLowQuality : public ::testing::TestWithParam<double> {};

// Through the whole servo, with a person at an Omni.
TEST_P(FeltLowQuality, KeepsTheForceThroughApproachAndRetract) {
  scene::SharedModel model = test::paper_model();
  model.material_count = 1;
  model.materials[0] = tapped_mica(GetParam());
  test::ServoBench bench(model);
  bench.arm(0);
  for (const double seconds : {2.0, 0.7, 8.0}) {
    for (const double height_m : {-0.018, 0.070}) {
      bench.move(height_m, seconds);
      EXPECT_EQ(bench.state().fault, scene::FaultCode::None) << seconds << " s to " << height_m;
      ASSERT_EQ(bench.state().servo_state, scene::ServoState::Running) << seconds << " s to " << height_m;
    }
  }
  EXPECT_FALSE(bench.samples.empty());
}

TEST_P(FeltLowQuality, GivesAHandNoEnergyOnAnyClosedPath) {
  const TappingHand::Given most = test::worst_of(tapped_mica(GetParam()), support::deep() ? 10'000 : 100);
  // a push that is held for a tick gives some 0.1 mJ a stroke, as any force of this stiffness does
  EXPECT_LT(most.push_j, 4e-4);
  EXPECT_LT(most.most_excess_j, PassivityObserver::kLimitJ);
}

INSTANTIATE_TEST_SUITE_P(Levers, FeltLowQuality, ::testing::Values(5.0, 20.0, 60.0),
                         [](const auto& test) { return "Q" + std::to_string(static_cast<int>(test.param)); });

}  // namespace felt_low_quality_test
}  // namespace afm::haptics
