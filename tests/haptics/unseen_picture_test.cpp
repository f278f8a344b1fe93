// SPDX-License-Identifier: Apache-2.0
// Invariant: while nobody sees the picture there is no force, and Turn-On gives none
#include <gtest/gtest.h>

#include "servo_bench.h"

// A headset that is off, lost or hidden: the renderer is alive, but its picture is not seen.
namespace afm::haptics {
namespace unseen_picture_test {

using scene::FaultCode;
using scene::ServoState;
using test::kMica;
using test::ServoBench;

TEST(UnseenPicture, TakesTheForceAwayAndGivesNoneUntilItIsSeenAgain) {
  ServoBench bench;
  bench.hold_attached(kMica);
  bench.unseen = true;
  bench.run(0.025);  // a fade of 20 ms, plus the tick that detects it
  EXPECT_EQ(bench.hand_force_n(), 0.0);
  EXPECT_EQ(bench.state().fault, FaultCode::PictureUnseen);
  bench.move(ServoBench::kTop, 0.3);
  bench.run(1.0);
  bench.aim(ServoBench::kTop, 0.0, true);
  bench.run(0.5);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed) << "armed although nobody sees the picture";
  bench.unseen = false;
  bench.run(0.5);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed) << "armed without another press";
  bench.aim(ServoBench::kTop, 0.0);
  bench.run(0.1);
  bench.arm(kMica);
}

TEST(UnseenPicture, IsNoFaultBeforeTheFirstOne) {
  ServoBench bench;
  bench.unseen = true;
  bench.choose(kMica);
  bench.run(0.5);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  EXPECT_EQ(bench.state().fault, FaultCode::None);
}

}  // namespace unseen_picture_test
}  // namespace afm::haptics
