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

struct Lever {
  std::string name;
  scene::SharedContact material;
  int paths = 10'000;  // in a deep run
};

// A polymer under a soft lever in a liquid.
scene::SharedContact soft() {
  scene::SharedContact material = test::tapped_polymer();
  material.contact.spring_constant = physics::Stiffness(2.0);
  material.contact.tip_radius = physics::Length(10e-9);
  material.lever.quality_factor = 20.0;
  return material;
}

// Same contact under a lever just below the least quality factor of the averages, with both jumps.
scene::SharedContact bistable() {
  scene::SharedContact material = test::tapped_polymer();
  material.contact.spring_constant = physics::Stiffness(4.0);
  material.lever.quality_factor = 99.0;
  return material;
}

class FeltLowQuality : public ::testing::TestWithParam<Lever> {};

// Through the whole servo, with a person at an Omni.
TEST_P(FeltLowQuality, KeepsTheForceThroughApproachAndRetract) {
  scene::SharedModel model = test::paper_model();
  model.material_count = 1;
  model.materials[0] = GetParam().material;
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
  const TappingHand::Given most = test::worst_of(GetParam().material, support::deep() ? GetParam().paths : 100);
  // a push that is held for a tick gives some 0.1 mJ a stroke, as any force of this stiffness does
  EXPECT_LT(most.push_j, 4e-4);
  EXPECT_LT(most.most_excess_j, PassivityObserver::kLimitJ);
}

INSTANTIATE_TEST_SUITE_P(Levers, FeltLowQuality,
                         ::testing::Values(Lever{"MicaQ5", tapped_mica(5.0)}, Lever{"MicaQ20", tapped_mica(20.0)},
                                           Lever{"MicaQ60", tapped_mica(60.0)}, Lever{"SoftPolymerQ20", soft(), 1000},
                                           Lever{"BistablePolymerQ99", bistable(), 1000}),
                         [](const auto& test) { return test.param.name; });

}  // namespace felt_low_quality_test
}  // namespace afm::haptics
