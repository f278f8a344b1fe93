// SPDX-License-Identifier: Apache-2.0
// Invariant: a servo tick neither allocates, locks nor throws
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "servo_bench.h"
#include "support/no_alloc.h"
#include "support/no_lock.h"
#include "support/particles/gold_particles.h"
#include "support/particles/ink_sample.h"
#include "support/particles/soft_sample.h"
#include "support/samples/measured_curve_of.h"
#include "support/samples/measured_surface.h"
#include "support/samples/rough_surface.h"

namespace servo_allocation_test {

using afm::physics::Law;
using afm::test::NoAllocation;
using afm::test::NoLock;
using afm::test::ServoBench;

TEST(ServoTick, NeitherAllocatesNorLocksNorThrowsOverACycleWithAChangeOfMaterial) {
  ServoBench bench(afm::test::rough_model());
  bench.arm(afm::test::kMica);

  // everything a tick may meet over a rough surface: both jumps, a choice of material and scale, edits of this material
  // and another, a new orientation, a hang, garbage; 10,000 ticks in all
  afm::scene::SceneTransforms transforms;
  transforms.count = 2;
  transforms.room_from_node[1][0] = transforms.room_from_node[1][9] = 1.0;
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
          bench.choose(afm::test::kGold, afm::scene::ScaleMode::Compressed);
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
      const NoAllocation no_allocation;
      const NoLock no_lock;
      bench.loop->tick(bench.now_ns, 0);
    }
    while (const auto event = bench.renderer.pop_event()) bench.events.push_back(*event);
  }
  EXPECT_EQ(bench.events.size(), 3U);
  EXPECT_EQ(bench.state().fault, afm::scene::FaultCode::RendererHung);
}

struct AnyLaw {
  std::string name;
  Law law;
  bool dynamic = false;
};

class ServoTickOf : public testing::TestWithParam<AnyLaw> {
 protected:
  // Mica, with the modulus and the lever that the paper does without.
  static afm::scene::SharedModel model() {
    afm::scene::SharedModel model = afm::test::paper_model();
    afm::scene::SharedContact& mica = model.materials[afm::test::kMica];
    mica.law = GetParam().law;
    mica.contact.reduced_modulus.si = 51.5e9;
    mica.dynamic = GetParam().dynamic ? 1 : 0;
    mica.lever = {afm::physics::Frequency(12e3), 2.5, afm::physics::Temperature(298.0)};
    if (GetParam().law == Law::Measured) afm::test::add_measured_curve(model, afm::test::kMica);
    return model;
  }
};

TEST(ServoTick, NeitherAllocatesNorLocksNorThrowsInAScanThatLeadsTheHandOrThatTheHandMakes) {
  using afm::scene::ScanHand;
  for (const ScanHand hand : {ScanHand::Led, ScanHand::Scans}) {
    ServoBench bench(afm::test::rough_model());
    bench.arm(afm::test::kMica);
    bench.aim(hand == ScanHand::Led ? ServoBench::kTop : -0.004, 0.5, true);
    int active = 0;
    for (int tick = 0; tick < 3000; ++tick) {
      bench.renderer.store(afm::scene::RendererHeartbeat{});
      bench.renderer.store(afm::scene::ScanLead{
          .time_ns = bench.now_ns, .apex_xy_m = {1e-12 * tick, 0.0}, .gain_per_s = 100.0, .hand = hand, .feedback = 1});
      bench.now_ns += bench.loop->period_ns();
      {
        const NoAllocation no_allocation;
        const NoLock no_lock;
        bench.loop->tick(bench.now_ns, 0);
      }
      if (bench.state().led != 0 || bench.state().level != 0) ++active;
    }
    EXPECT_GT(active, 1000);
    EXPECT_GT(bench.hand_force_n(), 0.05);
  }
}

TEST(ServoTick, NeitherAllocatesNorLocksNorThrowsWhileItPushesAParticle) {
  using afm::physics::PushState;
  afm::scene::SharedModel model = afm::test::paper_model();
  model.particles = afm::test::particles_at({{-80e-9, 0.0}, {80e-9, 100e-9}});
  ServoBench bench(model);
  bench.arm(afm::test::kMica, afm::scene::ScaleMode::Particles);
  const auto send = [&](double x_m, double height_m, double seconds) {
    bench.renderer.store(
        afm::scene::HandScript{.target_m = {x_m, height_m, 0.0}, .duration_s = seconds, .revision = ++bench.script});
  };
  send(-0.030, 0.030, 0.4);
  bench.run(0.5);
  send(-0.030, 0.001, 0.4);
  bench.run(0.5);
  send(0.010, 0.001, 2.0);
  int held = 0, slid = 0;
  for (int tick = 0; tick < 2900; ++tick) {
    if (tick == 2200) send(0.010, 0.060, 0.3);
    if (tick == 2600) {  // choice of the other tool
      bench.settings = {.tool = afm::scene::PushTool::Grip};
      bench.choose(afm::test::kMica, afm::scene::ScaleMode::Particles);
    }
    // a groove begins, takes another line, and ends
    if (tick % 700 == 100) {
      bench.renderer.store(afm::scene::PlannedPush{
          .from_m = {-80e-9, 1e-11 * tick}, .to_m = {50e-9, 0.0}, .particle = 0, .guided = tick < 1500 ? 1U : 0U});
    }
    bench.renderer.store(afm::scene::RendererHeartbeat{});
    bench.now_ns += bench.loop->period_ns();
    {
      const NoAllocation no_allocation;
      const NoLock no_lock;
      bench.loop->tick(bench.now_ns, 0);
    }
    const PushState state = bench.renderer.tip_push()->state;
    if (state == PushState::Holds) ++held;
    if (state == PushState::Slides) ++slid;
  }
  EXPECT_EQ(bench.state().fault, afm::scene::FaultCode::None);
  EXPECT_GT(held, 10);
  EXPECT_GT(slid, 100);
  EXPECT_EQ(bench.renderer.tip_push()->settings.tool, afm::scene::PushTool::Grip);
}

TEST(ServoTick, NeitherAllocatesNorLocksNorThrowsWhileItScratchesASoftSample) {
  ServoBench bench(afm::test::soft_model());
  bench.arm(afm::test::kMica, afm::scene::ScaleMode::Particles);
  const auto send = [&](double x_m, double height_m, double seconds) {
    bench.renderer.store(
        afm::scene::HandScript{.target_m = {x_m, height_m, 0.0}, .duration_s = seconds, .revision = ++bench.script});
  };
  send(-0.015, 0.030, 0.4);
  bench.run(0.5);
  send(-0.015, -0.010, 0.6);
  bench.run(0.7);
  send(0.040, -0.010, 0.6);  // partly too fast
  int marked = 0, raised = 0;
  for (int tick = 0; tick < 2600; ++tick) {
    if (tick == 650) send(-0.030, -0.010, 1.4);
    if (tick == 2100) send(-0.030, 0.060, 0.4);
    bench.renderer.store(afm::scene::RendererHeartbeat{});
    bench.now_ns += bench.loop->period_ns();
    {
      const NoAllocation no_allocation;
      const NoLock no_lock;
      bench.loop->tick(bench.now_ns, 0);
    }
    const auto push = bench.renderer.tip_push();
    if (push->state == afm::physics::PushState::Slides) ++marked;
    if (push->rise_m > 0.0) ++raised;
  }
  EXPECT_EQ(bench.state().fault, afm::scene::FaultCode::None);
  EXPECT_GT(marked, 100);
  EXPECT_GT(raised, 10);
}

TEST(ServoTick, NeitherAllocatesNorLocksNorThrowsWhileItWritesWithInk) {
  ServoBench bench(afm::test::ink_model());
  bench.arm(afm::test::kMica, afm::scene::ScaleMode::Particles);
  const auto send = [&](double x_m, double height_m, double seconds) {
    bench.renderer.store(
        afm::scene::HandScript{.target_m = {x_m, height_m, 0.0}, .duration_s = seconds, .revision = ++bench.script});
  };
  send(-0.015, 0.030, 0.4);
  bench.run(0.5);
  send(-0.015, -0.004, 0.6);
  bench.run(0.7);
  send(0.020, -0.004, 1.0);
  int wrote = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    if (tick == 1200) send(0.020, 0.060, 0.4);
    bench.renderer.store(afm::scene::RendererHeartbeat{});
    bench.now_ns += bench.loop->period_ns();
    {
      const NoAllocation no_allocation;
      const NoLock no_lock;
      bench.loop->tick(bench.now_ns, 0);
    }
    if (bench.renderer.tip_push()->state == afm::physics::PushState::Slides) ++wrote;
  }
  EXPECT_EQ(bench.state().fault, afm::scene::FaultCode::None);
  EXPECT_GT(wrote, 1000);
  EXPECT_EQ(bench.renderer.tip_push()->state, afm::physics::PushState::Free);
}

TEST_P(ServoTickOf, NeitherAllocatesNorLocksNorThrowsOverACycle) {
  ServoBench bench(model());
  bench.arm(afm::test::kMica);
  bench.aim(-0.02, 0.5);
  for (int tick = 0; tick < 1500; ++tick) {
    if (tick == 600) bench.aim(0.072, 0.5);
    bench.renderer.store(afm::scene::RendererHeartbeat{});
    bench.now_ns += bench.loop->period_ns();
    const NoAllocation no_allocation;
    const NoLock no_lock;
    bench.loop->tick(bench.now_ns, 0);
  }
  EXPECT_EQ(bench.state().fault, afm::scene::FaultCode::None);
  EXPECT_EQ(bench.state().servo_state, afm::scene::ServoState::Running);
  EXPECT_EQ(bench.state().phase, afm::physics::Phase::Free);
  EXPECT_EQ(bench.state().active.slow_motion > 1.0, GetParam().dynamic);
}

INSTANTIATE_TEST_SUITE_P(Laws, ServoTickOf,
                         testing::Values(AnyLaw{"Paper", Law::Paper}, AnyLaw{"Hao", Law::Hao},
                                         AnyLaw{"Hertz", Law::Hertz}, AnyLaw{"Dmt", Law::Dmt}, AnyLaw{"Jkr", Law::Jkr},
                                         AnyLaw{"MaugisDugdale", Law::MaugisDugdale},
                                         AnyLaw{"LennardJones", Law::LennardJones}, AnyLaw{"Measured", Law::Measured},
                                         AnyLaw{"DynamicDmt", Law::Dmt, true}),
                         [](const auto& test) { return test.param.name; });

TEST(ServoTickDeathTest, TheTrapItselfCatchesAnAllocation) {
  EXPECT_DEATH(
      {
        const NoAllocation guard;
        const auto number = std::make_unique<int>(3);
        std::printf("%d", *number);
      },
      "where no allocation is allowed");
}

TEST(ServoTickDeathTest, TheTrapItselfCatchesALockThatNobodyHolds) {
  EXPECT_DEATH(
      {
        std::mutex mutex;
        const NoLock guard;
        const std::lock_guard lock(mutex);
      },
      "pthread_mutex_lock where nothing may lock or throw");
}

TEST(ServoTickDeathTest, TheTrapItselfCatchesAnExceptionThatIsCaught) {
  EXPECT_DEATH(
      {
        const NoLock guard;
        try {
          throw 3;
        } catch (int) {
        }
      },
      "__cxa_allocate_exception where nothing may lock or throw");
}

TEST(ServoTick, NeitherAllocatesNorLocksNorThrowsOverATopographyOfTheMostPoints) {
  const afm::scene::Topography topography = afm::test::measured_surface();
  ServoBench bench(afm::test::measured_model(topography), 1000.0, {}, HUGE_VAL, topography);
  bench.hold_attached(afm::test::kMica);
  std::vector<double> work_us;
  work_us.reserve(4000);
  {
    const NoAllocation no_allocation;
    const NoLock no_lock;
    for (int tick = 0; tick < 4000; ++tick) {
      const double angle = 0.002 * tick;
      bench.renderer.store(afm::scene::RendererHeartbeat{.time_ns = bench.now_ns, .frame = ++bench.frame});
      bench.renderer.store(
          afm::scene::HandScript{.target_m = {0.03 * std::sin(angle), 0.025, 0.03 - 0.03 * std::cos(angle)},
                                 .duration_s = 0.001,
                                 .revision = ++bench.script,
                                 .turn_on_pressed = 0});
      bench.now_ns += bench.loop->period_ns();
      const auto begin = std::chrono::steady_clock::now();
      bench.loop->tick(bench.now_ns, 0);
      work_us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
    }
  }
  EXPECT_EQ(bench.state().servo_state, afm::scene::ServoState::Running);
  EXPECT_NE(bench.state().surface.height_m, 0.0);
  std::sort(work_us.begin(), work_us.end());
  RecordProperty("p99_us", std::to_string(work_us[work_us.size() * 99 / 100]));
}

}  // namespace servo_allocation_test
