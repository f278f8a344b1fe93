// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>

#include "servo_bench.h"
#include "support/no_alloc.h"

namespace {

using afm::test::NoAllocation;
using afm::test::ServoBench;

TEST(ServoTick, DoesNotAllocateOverACycleWithAChangeOfMaterial) {
  ServoBench bench;
  bench.arm(afm::test::kMica);

  // everything a tick may meet: both jumps, a choice, edits of this material and another, a new orientation, a hang,
  // garbage; 10,000 ticks in all
  afm::scene::SceneTransforms transforms;
  transforms.count = 2;
  transforms.room_from_node[1][9] = 1.0;
  int phase = 0;
  for (int tick = 0; tick < 10'000; ++tick) {
    if (tick % 1250 == 0) {
      switch (phase++) {
        case 0:
          bench.aim(-0.02, 0.5);
          break;
        case 1:
          bench.aim(0.072, 0.5);
          break;
        case 2:
          bench.choose(afm::test::kGold);
          break;
        case 3:
          bench.aim(0.060, 0.0, true);
          break;
        case 4:
          bench.aim(-0.02, 0.5);
          bench.edit(afm::test::kMica, bench.segment.model().materials[afm::test::kGold]);
          break;
        case 5:
          bench.renderer.store(transforms);
          bench.edit(afm::test::kGold, bench.segment.model().materials[afm::test::kMica]);
          break;
        case 6:
          bench.choose(99);
          break;
        default:
          bench.heartbeats = false;
      }
    }
    if (bench.heartbeats) bench.renderer.store(afm::scene::RendererHeartbeat{});
    bench.now_ns += bench.loop->period_ns();
    {
      const NoAllocation guard;
      bench.loop->tick(bench.now_ns, 0);
    }
    while (const auto event = bench.renderer.pop_event()) bench.events.push_back(*event);
  }
  EXPECT_EQ(bench.events.size(), 3U);
  EXPECT_EQ(bench.state().fault, afm::scene::FaultCode::RendererHung);
}

TEST(ServoTickDeathTest, TheTrapItselfCatchesAnAllocation) {
  EXPECT_DEATH(
      {
        const NoAllocation guard;
        const auto number = std::make_unique<int>(3);
        std::printf("%d", *number);
      },
      "where no allocation is allowed");
}

}  // namespace
