// SPDX-License-Identifier: Apache-2.0
// The servo among particles, with one tool and then another.
// Invariant: the tool among particles changes only without force, and moves none of them
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "pushing_bench.h"
#include "scene/shared/push_values.h"

namespace afm {
namespace servo_tools_test {

using physics::EventKind;
using scene::ScaleMode;
using test::PushingBench;

// With force on, the tool waits until the tip is off the sample, and changes only after the force is gone.
TEST(ServoTools, ChangesTheToolWithoutForceAndKeepsPlacesAndStrokes) {
  PushingBench bench;
  const auto choose = [&](scene::PushTool tool) {
    bench.settings.tool = tool;
    bench.choose(test::kMica, ScaleMode::Particles);
  };
  const auto tool = [&] { return bench.renderer.tip_push()->settings.tool; };
  const scene::ParticlePose start = bench.pose(0);
  bench.put_down();
  EXPECT_EQ(tool(), scene::PushTool::Push);
  bench.go(-0.012, 0.0, 0.001, 1.0);
  bench.go(-0.012, 0.0, -0.004, 0.3);
  ASSERT_EQ(bench.state().phase, physics::Phase::Attached);
  choose(scene::PushTool::Grip);
  bench.run(0.3);
  EXPECT_EQ(tool(), scene::PushTool::Push) << "the tip is on the sample";
  ASSERT_EQ(bench.state().servo_state, scene::ServoState::Running);
  bench.go(-0.012, 0.0, 0.050, 0.5);
  bench.run(0.3);
  EXPECT_EQ(tool(), scene::PushTool::Grip);
  for (std::size_t i = 1; i < bench.samples.size(); ++i) {
    const scene::TipSample &before = bench.samples[i - 1], &now = bench.samples[i];
    if (before.settings == now.settings || before.tick == 0) continue;
    EXPECT_FALSE(scene::is_armed(now.servo_state));
    EXPECT_EQ(before.hand_force_n, 0.0);
    EXPECT_EQ(now.push.digest, before.push.digest);
  }
  const scene::ParticlePose there = bench.pose(0);
  EXPECT_NE(there, start);
  EXPECT_EQ(bench.renderer.tip_push()->strokes, 1U);
  EXPECT_GE(bench.renderer.tip_push()->yields, 1U);

  // a tip that moves back drags the touched particle
  bench.put_down();
  bench.go(-0.011, 0.0, 0.001, 0.5);
  bench.go(-0.045, 0.0, 0.001, 1.0);
  EXPECT_GE(bench.count(EventKind::ParticleDragged), 1U);
  EXPECT_LT(bench.pose(0).x_m, there.x_m);
  bench.go(-0.045, 0.0, 0.050, 0.5);
  bench.release();
  choose(scene::PushTool::OfSet);
  bench.run(0.3);
  EXPECT_EQ(tool(), scene::PushTool::Push);
  EXPECT_EQ(bench.renderer.tip_push()->strokes, 2U);
  for (int i = 0; i < 2; ++i) bench.order(bench.taken_back);
  EXPECT_EQ(bench.pose(0), start);
  EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
  EXPECT_EQ(bench.renderer.refused_blocks(), 0U);
}

// A tip beside a particle is off the sample, but not without force.
TEST(ServoTools, ChangesNothingWhileAParticlePushesTheHand) {
  for (const bool material : {false, true}) {
    PushingBench bench;
    bench.put_down();
    bench.go(-0.020, 0.0, 0.001, 1.0);
    ASSERT_NE(bench.state().phase, physics::Phase::Attached);
    const double pushed_n = bench.sideways_n();
    ASSERT_GT(pushed_n, 0.1);
    if (!material) bench.settings.tool = scene::PushTool::Grip;
    bench.choose(material ? test::kGold : test::kMica, ScaleMode::Particles);
    const std::size_t before = bench.samples.size();
    bench.run(0.3);
    EXPECT_NEAR(bench.sideways_n(), pushed_n, 0.05 * pushed_n);
    EXPECT_EQ(bench.state().servo_state, scene::ServoState::Running);
    EXPECT_EQ(bench.state().material, test::kMica);
    EXPECT_EQ(bench.renderer.tip_push()->settings.tool, scene::PushTool::Push);
    bench.go(-0.030, 0.0, 0.001, 0.5);
    bench.run(0.3);
    EXPECT_EQ(bench.state().acknowledged.selection, bench.selection) << "back from the particle, not lifted";
    double last_n = pushed_n;
    for (std::size_t i = before; i < bench.samples.size(); ++i) {
      const scene::TipSample& now = bench.samples[i];
      if (now.settings.tool == scene::PushTool::Grip || now.material == test::kGold) {
        EXPECT_EQ(std::hypot(now.push.lateral_n[0], now.push.lateral_n[1]), 0.0);
        EXPECT_EQ(last_n, 0.0) << "the force of the tick before";
        break;
      }
      last_n = std::hypot(now.push.lateral_n[0], now.push.lateral_n[1]);
    }
    bench.release();
    EXPECT_EQ(bench.hand_force_n(), 0.0);
  }
}

TEST(ServoTools, GripsNoIslandAndHasNoLevelForIt) {
  for (const scene::PushSettings& settings :
       {scene::PushSettings{.tool = scene::PushTool::Grip}, scene::PushSettings{.level = 2}}) {
    scene::SharedModel model = test::two_particles();
    model.particles = test::islands_at({{0.0, 0.0}, {0.0, 600e-9}});
    PushingBench bench(1000.0, model);
    bench.choose(test::kMica, ScaleMode::Particles);
    bench.run(0.1);
    bench.settings = settings;
    bench.choose(test::kMica, ScaleMode::Particles);
    bench.run(0.1);
    EXPECT_EQ(bench.renderer.tip_push()->settings, scene::PushSettings{.tool = scene::PushTool::Push});
    EXPECT_EQ(bench.state().acknowledged.selection, bench.selection);
  }
}

// Law, lever, tip, level and medium, one after another: each without force, with all places kept, and felt in the next
// push.
TEST(ServoTools, ChangesEverySettingWithoutForceAndKeepsThePlaces) {
  PushingBench bench;
  const scene::ParticlePose start = bench.pose(0);
  // the push of a tip that has moved it, and is then lifted
  const auto push = [&bench] {
    bench.put_down();
    bench.go(-0.018, 0.0, 0.001, 1.0);
    const scene::TipPush newest = *bench.renderer.tip_push();
    bench.go(-0.018, 0.0, 0.050, 0.5);
    return newest;
  };
  const scene::TipPush as_set = push();
  ASSERT_GT(as_set.threshold_n, 0.0);
  EXPECT_EQ(as_set.settings, scene::PushSettings{.tool = scene::PushTool::Push});
  struct Change {
    scene::PushSettings settings;
    double least, most;  // limits of the threshold, relative to that of the set
  };
  // at rest and unloaded, gold gives at 14 times the force by Amontons; it moves at half of it; a meniscus makes the
  // contact larger, water makes it smaller
  for (const Change& change :
       {Change{{.law = 2}, 5.0, 20.0}, Change{{.lever = 4}, 0.5, 2.0}, Change{{.tip = 3}, 0.5, 2.0},
        Change{{.level = 3}, 0.9, 1.1}, Change{{.medium = 1}, 1.5, 3.0}, Change{{.lever = 1, .medium = 2}, 0.2, 0.6}}) {
    bench.release();
    const scene::ParticlePose there = bench.pose(0);
    const std::size_t before = bench.samples.size();
    bench.settings = change.settings;
    bench.choose(test::kMica, ScaleMode::Particles);
    bench.run(0.3);
    for (std::size_t i = before; i < bench.samples.size(); ++i) {
      if (bench.samples[i].settings == bench.samples[i - 1].settings) continue;
      EXPECT_EQ(bench.samples[i - 1].hand_force_n, 0.0);
      EXPECT_EQ(bench.samples[i].push.digest, bench.samples[i - 1].push.digest);
    }
    scene::PushSettings used = change.settings;
    used.tool = scene::PushTool::Push;
    ASSERT_EQ(bench.renderer.tip_push()->settings, used);
    EXPECT_EQ(bench.pose(0), there);
    bench.order(bench.put_back);
    const double share = push().threshold_n / as_set.threshold_n;
    EXPECT_GT(share, change.least) << scene::text_of(scene::PushSetting::Medium, used.medium);
    EXPECT_LT(share, change.most);
    EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
  }
  bench.release();
  while (bench.renderer.tip_push()->strokes > 0) bench.order(bench.taken_back);
  EXPECT_EQ(bench.pose(0), start);
  EXPECT_EQ(bench.renderer.refused_blocks(), 0U);
}

// The drift of level 2 begins when the level is chosen, goes on with other settings, and ends with the level.
TEST(ServoTools, BeginsTheDriftAtTheChangeOfTheLevel) {
  PushingBench bench;
  // time before the choice
  const auto choose = [&bench](const scene::PushSettings& settings) {
    bench.settings = settings;
    const std::int64_t before_ns = bench.now_ns;
    bench.choose(test::kMica, ScaleMode::Particles);
    bench.run(0.2);
    return before_ns;
  };
  const auto since_ns = [&bench] { return bench.samples.back().level.since_ns; };
  choose({});
  EXPECT_EQ(since_ns(), 0);
  const std::int64_t first_ns = choose({.level = 3}), begun_ns = since_ns();
  EXPECT_GT(begun_ns, first_ns);
  choose({.lever = 4, .level = 3});
  EXPECT_EQ(since_ns(), begun_ns);
  choose({.level = 2});
  EXPECT_EQ(since_ns(), 0);
  const std::int64_t again_ns = choose({.level = 3});
  EXPECT_GT(since_ns(), again_ns);
  choose({});
  EXPECT_EQ(since_ns(), 0);
}

// A servo that takes over uses the chosen settings from its first tick; those that cannot be felt change nothing.
TEST(ServoTools, KeepsTheSettingsOfAPredecessor) {
  PushingBench bench;
  bench.settings = {.tip = 3};
  bench.choose(test::kMica, ScaleMode::Particles);
  bench.run(0.1);
  bench.settings = {.law = 4};
  bench.choose(test::kMica, ScaleMode::Particles);
  bench.run(0.1);
  EXPECT_EQ(bench.renderer.tip_push()->settings.tip, 3U) << "there is no measured threshold";
  bench.settings = {.medium = 2};
  bench.choose(test::kMica, ScaleMode::Particles);
  haptics::SimulatedDevice device;
  auto successor = haptics::ServoLoop::create(bench.segment, device, {});
  ASSERT_TRUE(successor);
  (*successor)->tick(bench.now_ns += 1'000'000, 0);
  (*successor)->tick(bench.now_ns += 1'000'000, 0);
  EXPECT_EQ(bench.renderer.tip_push()->settings, (scene::PushSettings{.tool = scene::PushTool::Push, .medium = 2}));
}

}  // namespace servo_tools_test
}  // namespace afm
