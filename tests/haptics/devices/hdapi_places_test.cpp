// SPDX-License-Identifier: Apache-2.0
// A vendor's device whose sensors freeze or jump (haptics/position_check.h).
#include <gtest/gtest.h>

#include "hdapi_bench.h"

namespace hdapi_places_test {

using afm::scene::FaultCode;
using afm::test::HdapiBench;

TEST(HdapiPlaces, LosesItsForceWhenItsSensorFreezes) {
  HdapiBench bench;
  bench.hold_attached();
  mock_hd_hold_still();
  bench.run(990);
  EXPECT_GT(bench.felt(), 0.5);
  bench.run(20);
  EXPECT_EQ(bench.felt(), 0.0);
  EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
}

// Moves from a pulling place past the place of release, and back on every other tick.
TEST(HdapiPlaces, GivesNoOtherForceForPlacesWhereNoHandCanBe) {
  for (const double jump_mm : {5.0, 45.0, 50.0}) {
    SCOPED_TRACE(jump_mm);
    HdapiBench bench;
    bench.hold_attached();
    const double held_n = bench.felt();
    bench.largest_force_n = 0;
    for (int tick = 0; tick < 25; ++tick) {
      mock_hd_set_position(0, HdapiBench::kContactMm + 25 - (tick % 2 == 0 ? jump_mm : 0.0), 0);
      bench.tick();
    }
    EXPECT_LE(bench.largest_force_n, held_n + 0.01);
    EXPECT_EQ(bench.felt(), 0.0);
    EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
  }
}

}  // namespace hdapi_places_test
