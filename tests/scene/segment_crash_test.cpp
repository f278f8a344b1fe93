// SPDX-License-Identifier: Apache-2.0
// Invariant: a shared block is complete or absent, whichever process is killed
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <random>
#include <utility>

#include "scene/shared/shared_segment.h"
#include "support/paper_model.h"

// A process that writes its blocks as fast as it can is killed at a random moment, over and over; the other one reads
// all the while. Every block is computed from one number that it carries, so that a mixture of two is recognised.
namespace segment_crash_test {

using namespace afm::scene;
using std::chrono::microseconds;
using std::chrono::steady_clock;

constexpr int kKills = 1000;
constexpr std::uint64_t kSeedsOfWriter = 1'000'000;  // more seeds than one writer can use
constexpr std::uint64_t kSuccessor = (kKills + 1) * kSeedsOfWriter;

// A number that is plausible in every field, and differs from word to word.
double number(std::uint64_t seed, int word) {
  return 1e-9 * static_cast<double>((seed * 31 + static_cast<std::uint64_t>(word)) % 1'000'003);
}

TipState tip_state(std::uint64_t seed) {
  TipState state{.time_ns = static_cast<std::int64_t>(seed), .tick = seed, .tip = {.z_m = number(seed, 1)}};
  state.hand.position_m.fill(number(seed, 2));
  state.hand.force_n.fill(number(seed, 3));
  state.normal.fill(number(seed, 4));
  state.safety.observer_damping_n_s_per_m = number(seed, 5);
  state.material = static_cast<std::int32_t>(seed % 3);
  state.garbage_blocks = static_cast<std::uint32_t>(seed);
  return state;
}

ServoTiming timing(std::uint64_t seed) {
  ServoTiming timing{.ticks = seed};
  for (std::uint32_t i = 0; i < kHistogramBins; ++i) {
    timing.wake_us[i] = timing.work_us[i] = static_cast<std::uint32_t>(seed) + i;
  }
  return timing;
}

TipSample sample(std::uint64_t seed) {
  TipSample sample{.time_ns = static_cast<std::int64_t>(seed), .tick = seed, .tip = {.z_m = number(seed, 1)}};
  sample.hand_from_contact_m.fill(number(seed, 2));
  sample.surface.height_m = number(seed, 3);
  return sample;
}

TipEvent event(std::uint64_t seed) {
  return {.kind = afm::physics::EventKind::JumpToContact,
          .material = 0,
          .time_ns = static_cast<std::int64_t>(seed),
          .z_m = number(seed, 1),
          .force_after_n = number(seed, 2)};
}

// Its first number identifies the seed, up to a multiple of 1000.
SceneTransforms transforms(std::uint64_t seed) {
  SceneTransforms transforms{.count = 2};
  for (auto& matrix : transforms.room_from_node) matrix.fill(number(seed % 1000, 1));
  transforms.room_from_node[0][0] = static_cast<double>(seed % 1000);
  return transforms;
}

HandScript script(std::uint64_t seed) {
  HandScript script{.revision = static_cast<std::uint32_t>(seed)};
  script.target_m.fill(number(script.revision, 1));
  return script;
}

MaterialEdit edit(std::uint64_t seed) {
  MaterialEdit edit{.material = afm::test::paper_model().materials[0], .revision = static_cast<std::uint32_t>(seed)};
  edit.material.contact.tip_radius.si = 1e-9 * (1.0 + edit.revision);
  edit.material.lever.quality_factor = edit.revision;
  return edit;
}

template <class Block>
bool same(const Block& a, const Block& b) {
  return std::memcmp(&a, &b, sizeof(Block)) == 0;
}

// A child that calls `write(seed)` for seed, seed + 1, ... until it is killed. It dies with the test, too.
template <class Write>
pid_t start_writer(std::uint64_t seed, Write&& write) {
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  for (;;) write(seed++);
}

// Runs one writer after the other, each for a random time after its first value has come through; `read` is called all
// the while, and once more when each has died. It returns the seed of the newest value that it has found; that of one
// more writer must get through to it in the end.
template <class Write, class Read>
void kill_writers(Write&& write, Read&& read) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> life_us(0, 2000);
  const auto first_value = [&](std::uint64_t seed) {
    for (const auto end = steady_clock::now() + std::chrono::seconds(60); steady_clock::now() < end;) {
      if (read() >= seed) return true;
    }
    return false;
  };
  for (int i = 1; i <= kKills; ++i) {
    const std::uint64_t seed = static_cast<std::uint64_t>(i) * kSeedsOfWriter;
    const pid_t writer = start_writer(seed, write);
    ASSERT_GT(writer, 0);
    const bool began = first_value(seed);
    for (const auto end = steady_clock::now() + microseconds(life_us(random)); steady_clock::now() < end;) read();
    ASSERT_EQ(::kill(writer, SIGKILL), 0);
    ASSERT_EQ(::waitpid(writer, nullptr, 0), writer);
    ASSERT_TRUE(began) << "writer " << i << " was never heard of";
    read();
  }
  const pid_t successor = start_writer(kSuccessor, write);
  EXPECT_TRUE(first_value(kSuccessor));
  ::kill(successor, SIGKILL);
  ::waitpid(successor, nullptr, 0);
}

TEST(SegmentCrash, OfTheServoLeavesTheRendererWithWholeValues) {
  SharedSegment segment = std::move(*SharedSegment::create(afm::test::paper_model(), 0));
  RendererSide renderer = segment.renderer_side();
  std::uint64_t values = 0;
  std::uint64_t torn = 0;
  std::uint64_t newest = 0;  // newest value of all samples
  int unfinished = 0;
  const auto count = [&](bool whole) {
    ++values;
    if (!whole) ++torn;
  };
  kill_writers(
      [side = segment.servo_side()](std::uint64_t seed) mutable {
        side.store(tip_state(seed));
        side.push(sample(seed));
        side.push(event(seed));
        if (seed % 4 == 0) side.store(timing(seed));
      },
      [&] {
        const auto state = renderer.tip_state();
        if (!state) ++unfinished;
        if (state) count(same(*state, tip_state(state->tick)));
        if (const auto told = renderer.servo_timing()) count(same(*told, timing(told->ticks)));
        for (int i = 0; i < 64; ++i) {
          const auto next = renderer.pop_sample();
          if (!next) break;
          count(same(*next, sample(next->tick)));
          EXPECT_GE(next->tick, newest);
          newest = next->tick;
        }
        for (int i = 0; i < 64; ++i) {
          const auto next = renderer.pop_event();
          if (!next) break;
          count(same(*next, event(static_cast<std::uint64_t>(next->time_ns))));
        }
        return newest;
      });
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(renderer.refused_blocks(), 0U);
  EXPECT_GT(values, static_cast<std::uint64_t>(kKills));
  std::printf("%lu values read over %d kills, %d reads found a store that was never finished\n",
              static_cast<unsigned long>(values), kKills, unfinished);
}

TEST(SegmentCrash, OfTheRendererLeavesTheServoWithWholeValues) {
  SharedSegment segment = std::move(*SharedSegment::create(afm::test::paper_model(), 0));
  ServoSide servo = segment.servo_side();
  EditSide edits = segment.edit_side();
  std::uint64_t values = 0;
  std::uint64_t torn = 0;
  std::uint64_t newest = 0;
  std::uint64_t pushed = 0;
  const auto count = [&](bool whole) {
    ++values;
    if (!whole) ++torn;
  };
  kill_writers(
      [side = segment.renderer_side()](std::uint64_t seed) mutable {
        side.store(RendererHeartbeat{.time_ns = static_cast<std::int64_t>(seed), .frame = seed});
        side.store(script(seed));
        side.store(Selection{.material = static_cast<std::int32_t>(static_cast<std::uint32_t>(seed) % 3),
                             .revision = static_cast<std::uint32_t>(seed)});
        if (seed % 4 == 0) side.store(transforms(seed));
        if (seed % 4 == 1) side.store(edit(seed), 0);
        for (int i = 0; i < 4; ++i) side.pop_sample();
      },
      [&] {
        if (const auto heartbeat = servo.new_heartbeat()) {
          count(static_cast<std::uint64_t>(heartbeat->time_ns) == heartbeat->frame);
          newest = std::max(newest, heartbeat->frame);
        }
        if (const auto moved = servo.new_hand_script()) {
          count(moved->target_m == script(moved->revision).target_m);
        }
        if (const auto chosen = servo.new_selection()) {
          count(static_cast<std::uint32_t>(chosen->material) == chosen->revision % 3);
        }
        if (const auto placed = servo.new_transforms()) {
          count(same(*placed, transforms(static_cast<std::uint64_t>(placed->room_from_node[0][0]))));
        }
        if (const auto changed = edits.new_edit(0)) count(same(*changed, edit(changed->revision)));
        servo.push(sample(++pushed));
        return newest;
      });
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(servo.refused_blocks(), 0U);
  EXPECT_GT(values, static_cast<std::uint64_t>(kKills));

  // the successor finds the samples in order where the dead renderer left them
  RendererSide successor = segment.renderer_side();
  std::uint64_t before = 0;
  while (const auto next = successor.pop_sample()) {
    EXPECT_TRUE(same(*next, sample(next->tick)));
    EXPECT_GT(next->tick, before);
    before = next->tick;
  }
  std::printf("%lu values read over %d kills\n", static_cast<unsigned long>(values), kKills);
}

}  // namespace segment_crash_test
