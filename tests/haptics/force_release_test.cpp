// SPDX-License-Identifier: Apache-2.0
// The wall takes the force away without another sample: for a lesson's question, on the journey of scale, for a
// visitor.
// Invariant: the wall removes the force whether or not the sample changes
#include <gtest/gtest.h>

#include <algorithm>

#include "servo_bench.h"

namespace force_release_test {

using namespace afm::scene;
using afm::test::kGold;
using afm::test::kMica;
using afm::test::ServoBench;

TEST(ForceRelease, NeedsNoOtherMaterialAndDoesNotWaitForTheTip) {
  for (const bool attached : {false, true}) {
    ServoBench bench;
    attached ? bench.hold_attached(kMica) : bench.arm(kMica);
    bench.renderer.store(Selection{.material = kMica, .revision = ++bench.selection, .release = 1});
    bench.run(0.05);
    EXPECT_EQ(bench.hand_force_n(), 0.0) << attached;
    EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed) << attached;
    EXPECT_EQ(bench.state().fault, FaultCode::None) << attached;
    EXPECT_EQ(bench.state().acknowledged.selection, bench.selection) << attached;
    EXPECT_EQ(bench.state().material, kMica) << attached;
    EXPECT_TRUE(std::any_of(bench.samples.begin(), bench.samples.end(), [](const auto& s) { return s.changing != 0; }))
        << "a replay must know the reason";
    // once
    bench.move(ServoBench::kTop, 0.3);
    bench.run(1.0);
    bench.aim(ServoBench::kTop, 0.0, true);
    bench.run(0.7);
    EXPECT_EQ(bench.state().servo_state, ServoState::Running) << attached;
  }
}

TEST(ForceRelease, ComesBeforeAnotherMaterialIsLaid) {
  ServoBench bench;
  bench.hold_attached(kMica);
  bench.renderer.store(Selection{.material = kGold, .revision = ++bench.selection, .release = 1});
  bench.run(0.05);
  EXPECT_EQ(bench.hand_force_n(), 0.0);
  EXPECT_EQ(bench.state().material, kGold);
}

}  // namespace force_release_test
