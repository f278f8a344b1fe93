// SPDX-License-Identifier: Apache-2.0
// Invariant: invalid data in a shared block is refused
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

#include "haptics/safety.h"
#include "servo_bench.h"

// Possible writes of a renderer out of control, while the hand is held.
namespace shared_garbage_test {

using namespace afm::scene;
using afm::haptics::SafetyGovernor;
using afm::test::kMica;
using afm::test::ServoBench;

constexpr int kRounds = 10'000;

class Garbage {
 public:
  // Every byte.
  template <class Block>
  Block noise() {
    std::array<std::uint64_t, (sizeof(Block) + 7) / 8> words;
    for (auto& word : words) word = random_();
    Block block;
    std::memcpy(static_cast<void*>(&block), words.data(), sizeof(Block));
    return block;
  }

  // Flips one bit of a good block.
  template <class Block>
  Block flipped(Block block) {
    auto* bytes = reinterpret_cast<unsigned char*>(&block);
    bytes[random_() % sizeof(Block)] ^= static_cast<unsigned char>(1U << (random_() % 8));
    return block;
  }

  bool coin() { return random_() % 2 == 0; }
  std::uint64_t number(std::uint64_t below) { return random_() % below; }

 private:
  std::mt19937_64 random_{5};
};

SceneTransforms good_transforms() {
  SceneTransforms transforms{.count = 2};
  for (std::size_t node = 0; node < 2; ++node) {
    transforms.room_from_node[node] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 1.5, 0, 1};
  }
  return transforms;
}

// Writes every block that is the renderer's.
void write_all(ServoBench& bench, Garbage& garbage) {
  RendererSide& side = bench.renderer;
  if (garbage.coin()) {
    side.store(garbage.noise<SceneTransforms>());
    side.store(garbage.noise<Selection>());
    side.store(garbage.noise<MaterialEdit>(), static_cast<std::uint32_t>(garbage.number(kMaxMaterials)));
    side.store(garbage.noise<HandScript>());
    side.store(garbage.noise<ScanLead>());
    side.store(garbage.noise<RendererHeartbeat>());
    side.store(garbage.noise<PlannedPush>());
  } else {
    side.store(garbage.flipped(good_transforms()));
    side.store(garbage.flipped(Selection{.material = kMica, .revision = 1}));
    side.store(garbage.flipped(HandScript{.target_m = {0, 0.02, 0}, .duration_s = 0.5, .revision = ++bench.script}));
    side.store(garbage.flipped(ScanLead{.time_ns = bench.now_ns,
                                        .apex_xy_m = {1e-9, -1e-9},
                                        .height_m = 1e-9,
                                        .gain_per_s = 2000.0,
                                        .hand = garbage.coin() ? ScanHand::Led : ScanHand::Scans,
                                        .feedback = 1}));
    RendererHeartbeat heartbeat = garbage.flipped(RendererHeartbeat{});
    heartbeat.leaving &= ~1U;  // bit cleared, since leaving, Stop and an unseen picture are accepted
    heartbeat.stop &= ~1U;
    heartbeat.unseen &= ~1U;
    side.store(heartbeat);
    side.store(garbage.flipped(PlannedPush{.to_m = {1e-7, 0.0}, .particle = 0, .guided = 1}));
  }
}

TEST(SharedGarbage, IsRefusedAndCountedWhileTheForceStaysWithinItsLimits) {
  ServoBench bench;
  Garbage garbage;
  bench.hold_attached(kMica);
  const double cap_n = afm::haptics::force_cap_n(bench.device.spec());
  const double step_n = SafetyGovernor::kSlewNPerS * 1e-9 * static_cast<double>(bench.loop->period_ns());

  const std::uint32_t refused_before = bench.state().garbage_blocks;
  std::uint32_t with_force = 0;
  std::array<double, 3> before_n = bench.state().hand.force_n;
  testing::internal::CaptureStderr();
  for (int round = 0; round < kRounds; ++round) {
    // the hand returns to the sample now and then; otherwise everything would happen without force
    if (round % 2500 == 2499) bench.hold_attached(kMica);
    before_n = bench.state().hand.force_n;
    write_all(bench, garbage);
    bench.loop->edits().build();
    bench.now_ns += bench.loop->period_ns();
    bench.loop->tick(bench.now_ns, 0);

    const TipState state = bench.state();
    double force_n = 0;
    double change_n = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_TRUE(std::isfinite(state.hand.force_n[axis]));
      force_n = std::hypot(force_n, state.hand.force_n[axis]);
      change_n = std::hypot(change_n, state.hand.force_n[axis] - before_n[axis]);
    }
    if (force_n > 0) ++with_force;
    ASSERT_LE(force_n, cap_n * (1 + 1e-12));
    ASSERT_TRUE(force_n == 0 || change_n <= step_n * (1 + 1e-9)) << change_n;
  }
  const std::string said = testing::internal::GetCapturedStderr();
  const auto commands_a_terminal = [](char byte) { return (byte < ' ' && byte != '\n') || byte > '~'; };
  EXPECT_EQ(std::count_if(said.begin(), said.end(), commands_a_terminal), 0);
  EXPECT_GT(bench.state().garbage_blocks, refused_before + kRounds);
  EXPECT_GT(with_force, static_cast<std::uint32_t>(kRounds) / 100);
  std::printf("%u blocks refused in %d rounds, %u of them with force\n", bench.state().garbage_blocks - refused_before,
              kRounds, with_force);
}

// A hand that is led, or that scans, by a renderer that writes only places of a scan, of whatever numbers.
TEST(SharedGarbage, OfAScanLeavesTheForceWithinItsLimits) {
  for (const ScanHand hand : {ScanHand::Led, ScanHand::Scans}) {
    ServoBench bench;
    Garbage garbage;
    if (hand == ScanHand::Led) {
      bench.arm(kMica);
      bench.aim(ServoBench::kTop, 0.0, true);
    } else {
      bench.hold_attached(kMica);
    }
    const double step_n = SafetyGovernor::kSlewNPerS * 1e-9 * static_cast<double>(bench.loop->period_ns());
    std::array<double, 3> before_n{};
    int with_force = 0, led = 0;
    for (int round = 0; round < kRounds; ++round) {
      const ScanLead good{.time_ns = bench.now_ns,
                          .apex_xy_m = {1e-9 * static_cast<double>(garbage.number(2)), 0.0},
                          .gain_per_s = 1.0,
                          .hand = hand,
                          .feedback = 1};
      // long enough without for the hand to be led
      if (round % 16 == 0) bench.renderer.store(round % 1600 < 1200 ? good : garbage.flipped(good));
      if (round % 1600 == 1598) bench.aim(ServoBench::kTop, 0.0, false);
      if (round % 1600 == 1599 && hand == ScanHand::Led) bench.aim(ServoBench::kTop, 0.0, true);
      before_n = bench.state().hand.force_n;
      bench.tick();
      const TipState state = bench.state();
      double force_n = 0, change_n = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_TRUE(std::isfinite(state.hand.force_n[axis]));
        force_n = std::hypot(force_n, state.hand.force_n[axis]);
        change_n = std::hypot(change_n, state.hand.force_n[axis] - before_n[axis]);
      }
      if (force_n > 0) ++with_force;
      if (state.led != 0) ++led;
      ASSERT_LE(force_n, afm::haptics::force_cap_n(bench.device.spec()) * (1 + 1e-12));
      ASSERT_TRUE(force_n == 0 || change_n <= step_n * (1 + 1e-9)) << change_n;
    }
    EXPECT_GT(with_force, kRounds / 10);
    EXPECT_EQ(led > kRounds / 4, hand == ScanHand::Led) << led;
  }
}

}  // namespace shared_garbage_test
