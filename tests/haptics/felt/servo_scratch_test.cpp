// SPDX-License-Identifier: Apache-2.0
// The servo on a soft sample: a simulated hand that scratches it, and what it publishes.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "servo_bench.h"
#include "support/particles/soft_sample.h"

namespace afm {
namespace servo_scratch_test {

using physics::EventKind;
using scene::ScaleMode;
using test::ServoBench;

class ScratchingBench : public ServoBench {
 public:
  explicit ScratchingBench(double rate_hz = 1000.0) : ServoBench(test::soft_model(), rate_hz) {}

  void send(double x_m, double y_m, double height_m, double seconds) {
    renderer.store(scene::HandScript{.target_m = {x_m, height_m, -y_m}, .duration_s = seconds, .revision = ++script});
  }
  void go(double x_m, double y_m, double height_m, double seconds) {
    send(x_m, y_m, height_m, seconds);
    while (state().acknowledged.hand_script != script) tick();
  }

  // A scratch of 30 mm in the hand, and the hand lifted.
  void scratch(double y_m) {
    arm(test::kMica, ScaleMode::Particles);
    go(-0.015, y_m, 0.030, 0.4);
    go(-0.015, y_m, -0.010, 0.6);
    go(0.015, y_m, -0.010, 1.0);
    go(0.015, y_m, 0.060, 0.6);
    run(0.3);
  }

  void release() {
    renderer.store(scene::Selection{
        .material = test::kMica, .revision = ++selection, .scale_mode = ScaleMode::Particles, .release = 1});
    run(0.3);
  }

  void order(std::uint32_t& orders) {
    ++orders;
    run(0.4);  // time to send the surface tile by tile
  }

  std::vector<scene::MarkTile>& tiles() {
    all.resize(scene::kMarkTiles);
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      if (const auto newer = renderer.new_mark_tile(i)) all[i] = *newer;
    }
    return all;
  }

  std::size_t count(EventKind kind) const {
    return static_cast<std::size_t>(
        std::count_if(events.begin(), events.end(), [&](const scene::TipEvent& e) { return e.kind == kind; }));
  }

  std::vector<scene::MarkTile> all;
};

TEST(ServoOnASoftSample, PublishesMarksAndTheForceOfTheHand) {
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    ScratchingBench bench(rate_hz);
    bench.arm(test::kMica, ScaleMode::Particles);
    bench.go(-0.015, 0.0, 0.030, 0.4);
    EXPECT_EQ(scene::digest_of(bench.tiles()), scene::kSoftDigest) << "level";
    bench.go(-0.015, 0.0, -0.010, 0.6);
    double most_up_n = 0.0, most_sideways_n = 0.0, before_n = bench.hand_force_n(), deepest_m = 0.0;
    bench.send(0.015, 0.0, -0.010, 1.0);
    while (bench.state().acknowledged.hand_script != bench.script) {
      bench.tick();
      const auto force_n = bench.state().hand.force_n;
      most_up_n = std::max(most_up_n, force_n[1]);
      most_sideways_n = std::max(most_sideways_n, std::hypot(force_n[0], force_n[2]));
      ASSERT_LE(std::abs(bench.hand_force_n() - before_n),
                bench.state().safety.slew_limit_n_per_s / rate_hz * (1.0 + 1e-6));
      before_n = bench.hand_force_n();
      const auto push = bench.renderer.tip_push();
      ASSERT_TRUE(push);
      ASSERT_EQ(push->tick, bench.state().tick);
      ASSERT_EQ(push->digest, bench.samples.back().push.digest);
      ASSERT_GE(push->given_j - push->lost_j - push->stored_j, -1e-12 * std::abs(push->given_j));
      deepest_m = std::min(deepest_m, push->apex_m[2]);
    }
    EXPECT_GT(most_up_n, 0.2) << rate_hz;
    EXPECT_GT(most_sideways_n, 0.05) << rate_hz;
    EXPECT_LT(most_sideways_n, most_up_n);
    EXPECT_LT(deepest_m, -1e-9);
    EXPECT_EQ(bench.count(EventKind::SurfaceMarked), 1U);
    EXPECT_EQ(bench.count(EventKind::JumpToContact), 0U) << "no law of force beside it";
    bench.go(0.015, 0.0, 0.060, 0.6);
    bench.run(0.3);
    EXPECT_EQ(bench.hand_force_n(), 0.0);
    EXPECT_EQ(scene::digest_of(bench.tiles()), bench.renderer.tip_push()->digest) << "every tile has been published";
    EXPECT_NE(scene::digest_of(bench.tiles()), scene::kSoftDigest);
    EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
    EXPECT_EQ(bench.renderer.refused_blocks(), 0U);
  }
}

TEST(ServoOnASoftSample, FeelsAndMarksNothingWithoutForceOrOnAnotherScale) {
  ScratchingBench bench;
  bench.choose(test::kMica, ScaleMode::Particles);
  bench.run(0.2);
  bench.go(0.0, 0.0, -0.010, 0.5);
  EXPECT_EQ(bench.hand_force_n(), 0.0);
  EXPECT_EQ(bench.renderer.tip_push()->met, 0U);
  bench.go(0.0, 0.0, 0.070, 0.5);
  bench.arm(test::kMica, ScaleMode::Fit);
  bench.go(0.0, 0.0, -0.005, 0.8);
  EXPECT_GT(bench.hand_force_n(), 0.05) << "the law of the material";
  EXPECT_EQ(scene::digest_of(bench.tiles()), scene::kSoftDigest);
}

TEST(ServoOnASoftSample, TakesScratchesBack) {
  ScratchingBench bench;
  bench.scratch(0.0);
  const std::uint64_t one = bench.renderer.tip_push()->digest;
  bench.release();
  bench.scratch(0.008);
  EXPECT_EQ(bench.renderer.tip_push()->strokes, 2U);
  ++bench.taken_back;
  bench.run(0.1);
  EXPECT_EQ(bench.count(EventKind::PushTakenBack), 0U) << "there is force";
  bench.release();
  bench.order(bench.taken_back);
  EXPECT_EQ(bench.count(EventKind::PushTakenBack), 1U);
  EXPECT_EQ(bench.renderer.tip_push()->digest, one);
  bench.order(bench.put_back);
  EXPECT_EQ(bench.count(EventKind::ParticlesPutBack), 1U);
  EXPECT_EQ(bench.renderer.tip_push()->digest, scene::kSoftDigest);
  EXPECT_EQ(scene::digest_of(bench.tiles()), scene::kSoftDigest);
}

TEST(ServoOnASoftSample, ASuccessorGoesOnWithTheMarks) {
  ScratchingBench bench;
  bench.scratch(0.0);
  const std::uint64_t digest = bench.renderer.tip_push()->digest;
  haptics::SimulatedDevice hand;
  const auto successor = haptics::ServoLoop::create(bench.segment, hand, {.rate_hz = 1000.0});
  ASSERT_TRUE(successor) << successor.error().message;
  (*successor)->tick(bench.now_ns += 1'000'000, 0);
  EXPECT_EQ(bench.renderer.tip_push()->digest, digest);
}

}  // namespace servo_scratch_test
}  // namespace afm
