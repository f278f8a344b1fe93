// SPDX-License-Identifier: Apache-2.0
// The servo among particles: a simulated hand that pushes them, and what it publishes.
// Invariant: particles stay put after an edit or a change of scale
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics/manipulation/half_turn.h"
#include "pushing_bench.h"

namespace afm {
namespace servo_particles_test {

using physics::EventKind;
using scene::ScaleMode;
using test::PushingBench;

TEST(ServoAmongParticles, PublishesWhatTheHandFeels) {
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    PushingBench bench(rate_hz);
    bench.put_down();
    const double start_m = bench.pose(0).x_m;
    double most_n = 0.0;
    bench.send(-0.012, 0.0, 0.001, 1.0);
    while (bench.state().acknowledged.hand_script != bench.script) {
      bench.tick();
      most_n = std::max(most_n, bench.sideways_n());
      const auto push = bench.renderer.tip_push();
      ASSERT_TRUE(push);
      ASSERT_EQ(push->tick, bench.state().tick);
      ASSERT_EQ(push->digest, bench.samples.back().push.digest);
    }
    EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
    EXPECT_GT(bench.pose(0).x_m, start_m + 5e-9) << rate_hz;
    EXPECT_NE(bench.pose(0).moved, physics::PushState::Free);
    EXPECT_GT(most_n, 0.45);
    EXPECT_LT(most_n, 0.60);
    EXPECT_GE(bench.count(EventKind::ParticleTouched), 1U);
    EXPECT_GE(bench.count(EventKind::ParticleGave), 1U);
    EXPECT_EQ(bench.state().active.scale_mode, ScaleMode::Particles);
    EXPECT_EQ(bench.renderer.refused_blocks(), 0U);
  }
}

// The same code as for a hand of flesh: an island beside whose middle the tip pushes gives at its threshold, turns, and
// is lost.
TEST(ServoAmongParticles, TurnsAnIslandAndLosesIt) {
  std::vector<double> turned_rad, x_m;
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    scene::SharedModel model = test::paper_model();
    model.particles = test::islands_at({{0.0, 0.0}, {0.0, 600e-9}});
    PushingBench bench(rate_hz, model);
    bench.tick();
    const auto scale = bench.renderer.tip_push();
    ASSERT_TRUE(scale);
    const double beside_m = 15e-9 * scale->hand_m_per_m, side_m = 1.6e-7 * scale->hand_m_per_m;
    bench.arm(test::kMica, ScaleMode::Particles);
    bench.go(-side_m, -beside_m, 0.030, 0.4);
    bench.go(-side_m, -beside_m, 0.0, 0.4);
    double most_n = 0.0, before_n = bench.sideways_n();
    bench.send(2.5 * side_m, -beside_m, 0.0, 4.0);
    while (bench.state().acknowledged.hand_script != bench.script) {
      bench.tick();
      const double now_n = bench.sideways_n();
      ASSERT_LE(std::abs(now_n - before_n), bench.state().safety.slew_limit_n_per_s / rate_hz * (1.0 + 1e-6));
      before_n = now_n;
      most_n = std::max(most_n, now_n);
      const auto push = bench.renderer.tip_push();
      ASSERT_TRUE(push);
      ASSERT_GE(push->given_j - push->lost_j - push->stored_j, -1e-12 * std::abs(push->given_j));
    }
    EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
    EXPECT_GE(bench.count(EventKind::ParticleTouched), 1U);
    EXPECT_GE(bench.count(EventKind::ParticleGave), 1U);
    EXPECT_EQ(bench.count(EventKind::ParticleLost), 1U) << rate_hz;
    EXPECT_GT(most_n, 0.15);
    EXPECT_LT(bench.sideways_n(), 0.02);
    turned_rad.push_back(physics::angle_rad(scene::turn_of(bench.pose(0))));
    x_m.push_back(bench.pose(0).x_m);
    EXPECT_GT(std::abs(turned_rad.back()), 0.2);
    EXPECT_GT(x_m.back(), 50e-9);
  }
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_NEAR(turned_rad[i], turned_rad[2], 0.02) << i;
    EXPECT_NEAR(x_m[i], x_m[2], 5e-9) << i << ": the hand's own way, too, depends on the rate";
  }
}

// A contact that tears drops the force within the limits of the governor.
TEST(ServoAmongParticles, TearOffWithoutAKick) {
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    scene::SharedModel model = test::paper_model();
    scene::SharedSpecies gold = test::gold_species();
    gold.shear_strength_pa = 100e6;
    gold.sticks = 1;
    model.particles = test::particles_at({{-80e-9, 0.0}, {80e-9, 100e-9}}, gold);
    PushingBench bench(rate_hz, model);
    bench.put_down();
    double most_n = 0.0, before_n = bench.sideways_n();
    const auto go = [&](double x_m) {
      bench.send(x_m, 0.0, 0.001, 2.0);
      while (bench.state().acknowledged.hand_script != bench.script) {
        bench.tick();
        const double now_n = bench.sideways_n();
        ASSERT_LE(std::abs(now_n - before_n), bench.state().safety.slew_limit_n_per_s / rate_hz * (1.0 + 1e-6));
        ASSERT_LE(now_n, bench.state().safety.force_cap_n * (1.0 + 1e-9));
        before_n = now_n;
        if (bench.count(EventKind::ParticleTorn) == 0) most_n = std::max(most_n, now_n);
      }
    };
    go(-0.0235);
    go(-0.040);
    EXPECT_EQ(bench.count(EventKind::ParticleTorn), 1U) << rate_hz;
    EXPECT_GT(most_n, 0.1);
    EXPECT_LT(bench.sideways_n(), 0.02);
    EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
  }
}

TEST(ServoAmongParticles, FeelsAndMovesNothingWithoutForce) {
  PushingBench bench;
  bench.choose(test::kMica, ScaleMode::Particles);
  bench.run(0.2);
  bench.go(-0.030, 0.0, 0.001, 0.4);
  bench.go(0.030, 0.0, 0.001, 0.5);
  EXPECT_EQ(bench.renderer.tip_push()->met, 0U);
  EXPECT_EQ(bench.pose(0).x_m, -80e-9);
  EXPECT_EQ(bench.hand_force_n(), 0.0);
}

// A hand with a grip of 200 N/m that aims 0.4 mm off the middle pushes the particle by most of its width.
TEST(ServoAmongParticles, AHandThatIsALittleOffTheLinePushes) {
  PushingBench bench;
  bench.put_down();
  bench.go(-0.030, 0.0004, 0.001, 0.3);
  bench.go(0.010, 0.0004, 0.001, 4.0);
  EXPECT_GT(bench.pose(0).x_m, -80e-9 + 35e-9);
  EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
}

TEST(ServoAmongParticles, ASuccessorGoesOnWithThePoses) {
  PushingBench bench;
  bench.put_down();
  bench.go(-0.010, 0.0, 0.001, 1.0);
  const scene::ParticlePose there = bench.pose(0);
  const std::uint64_t digest = bench.renderer.tip_push()->digest;
  haptics::SimulatedDevice hand;
  const auto successor = haptics::ServoLoop::create(bench.segment, hand, {.rate_hz = 1000.0});
  ASSERT_TRUE(successor) << successor.error().message;
  EXPECT_EQ(bench.pose(0), there);
  (*successor)->tick(bench.now_ns += 1'000'000, 0);
  EXPECT_EQ(bench.renderer.tip_push()->digest, digest);
}

TEST(ServoAmongParticles, AnEditAndAnotherScaleLeaveThemWhereTheyAre) {
  PushingBench bench;
  bench.put_down();
  bench.go(-0.010, 0.0, 0.001, 1.0);
  bench.go(-0.010, 0.0, 0.050, 0.5);
  const scene::ParticlePose there = bench.pose(0);
  scene::SharedContact harder = bench.segment.model().materials[test::kMica];
  harder.contact.spring_constant = physics::Stiffness(0.2);
  bench.edit(test::kMica, harder);
  bench.run(1.0);
  ASSERT_EQ(bench.state().active.edit_revision, 1U);
  bench.choose(test::kMica, ScaleMode::Fit);
  bench.run(0.5);
  bench.arm(test::kMica, ScaleMode::Particles);
  EXPECT_EQ(bench.pose(0), there);
  bench.go(-0.030, 0.0, 0.030, 0.4);
  bench.go(-0.030, 0.0, 0.001, 0.4);
  bench.go(0.0, 0.0, 0.001, 1.5);
  EXPECT_GT(bench.pose(0).x_m, there.x_m + 5e-9);
}

TEST(ServoAmongParticles, TakesPushAfterPushBackBitForBit) {
  PushingBench bench;
  const scene::ParticlePose start = bench.pose(0);
  bench.tick();
  const std::uint64_t at_start = bench.renderer.tip_push()->digest;
  bench.push_to(-0.012);
  const scene::ParticlePose once = bench.pose(0);
  const std::uint64_t after_one = bench.renderer.tip_push()->digest;
  bench.release();
  bench.push_to(-0.004);
  ASSERT_NE(bench.pose(0), once);
  EXPECT_EQ(bench.renderer.tip_push()->strokes, 2U);
  bench.release();
  bench.order(bench.taken_back);
  EXPECT_EQ(bench.pose(0), once);
  EXPECT_EQ(bench.renderer.tip_push()->digest, after_one);
  EXPECT_EQ(bench.count(EventKind::PushTakenBack), 1U);
  bench.order(bench.taken_back);
  EXPECT_EQ(bench.pose(0), start);
  EXPECT_EQ(bench.renderer.tip_push()->strokes, 0U);
  EXPECT_EQ(bench.renderer.tip_push()->digest, at_start);
  bench.order(bench.taken_back);
  EXPECT_EQ(bench.count(EventKind::PushTakenBack), 2U) << "there is none";

  // the future depends only on these places
  bench.push_to(-0.012);
  EXPECT_GT(bench.pose(0).x_m, start.x_m + 5e-9);
  EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
}

TEST(ServoAmongParticles, TakesNoPushBackWhileThereIsAForce) {
  PushingBench bench;
  bench.push_to(-0.012);
  const scene::ParticlePose there = bench.pose(0);
  ASSERT_EQ(bench.state().servo_state, scene::ServoState::Running);
  bench.order(bench.taken_back);
  bench.order(bench.put_back);
  bench.run(0.1);
  bench.release();
  bench.run(0.5);
  EXPECT_EQ(bench.pose(0), there) << "an order that came too early is dropped";
  EXPECT_EQ(bench.count(EventKind::PushTakenBack) + bench.count(EventKind::ParticlesPutBack), 0U);
}

TEST(ServoAmongParticles, PutsAllBackAndTakesThatBackToo) {
  PushingBench bench;
  const scene::ParticlePose start = bench.pose(0);
  bench.push_to(-0.012);
  bench.release();
  bench.push_to(-0.004);
  const scene::ParticlePose there = bench.pose(0);
  bench.release();
  bench.order(bench.put_back);
  EXPECT_EQ(bench.pose(0), start);
  bench.order(bench.put_back);
  EXPECT_EQ(bench.count(EventKind::ParticlesPutBack), 1U) << "nothing had moved since";
  bench.order(bench.taken_back);
  EXPECT_EQ(bench.pose(0), there);
}

TEST(ServoAmongParticles, StoresTheirPagesOnceOnAnyScale) {
  PushingBench bench;
  bench.push_to(-0.012);
  bench.release();
  bench.choose(test::kMica, ScaleMode::Fit);
  bench.run(0.3);
  const auto page_is_new = [&] { return bench.renderer.new_particle_page(0).has_value(); };
  page_is_new();
  bench.order(bench.put_back);
  EXPECT_EQ(bench.count(EventKind::ParticlesPutBack), 1U);
  EXPECT_TRUE(page_is_new());
  bench.tick();
  EXPECT_FALSE(page_is_new());
}

// A renderer that replaces another does not repeat its orders.
TEST(ServoAmongParticles, AnotherRendererTakesNothingBackByBeginning) {
  PushingBench bench;
  bench.push_to(-0.012);
  bench.release();
  bench.push_to(-0.004);
  bench.release();
  bench.order(bench.taken_back);
  const scene::ParticlePose there = bench.pose(0);
  bench.taken_back = 0;
  bench.tick();
  EXPECT_EQ(bench.pose(0), there);
  bench.order(bench.taken_back);
  EXPECT_NE(bench.pose(0), there);
}

}  // namespace servo_particles_test
}  // namespace afm
