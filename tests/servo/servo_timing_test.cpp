// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <vector>

#include "core/clock.h"
#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "live_renderer.h"

// Times of the ticks, and the force when they come late. Real time.
namespace servo_timing_test {

using namespace afm::scene;
using namespace afm::test;
using afm::haptics::ServoLoop;
using afm::haptics::ServoSettings;
using afm::servo::ServoProcess;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::int64_t kPeriodNs = 1'000'000;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

struct Ran {
  double processor_s_per_tick = 0;
  std::vector<TipSample> samples;
};

Ran run_servo(const afm::haptics::ServoSettings& settings) {
  SharedSegment segment = create_segment();
  RendererSide side = segment.renderer_side();
  side.store(Selection{.material = kMica, .revision = 1});
  afm::haptics::SimulatedDevice device;
  auto loop = afm::haptics::ServoLoop::create(segment, device, settings);
  EXPECT_TRUE(loop);
  Ran ran;
  std::thread servo([&] {
    (*loop)->run(afm::core::MonotonicClock());
    rusage used{};
    ::getrusage(RUSAGE_THREAD, &used);
    ran.processor_s_per_tick =
        (seconds(used.ru_utime) + seconds(used.ru_stime)) / static_cast<double>((*loop)->timing().ticks);
  });
  EXPECT_TRUE(LiveRenderer(side).until([](const TipState& state) { return state.tick >= 300; }));
  (*loop)->stop();
  servo.join();
  while (const auto sample = side.pop_sample()) ran.samples.push_back(*sample);
  return ran;
}

TEST(SpinningServo, StaysAwakeForTheEndOfEveryPeriodAndNeverTicksEarly) {
  const Ran asleep = run_servo({.rate_hz = kRateHz});
  const Ran awake = run_servo({.rate_hz = kRateHz, .spin_ns = kPeriodNs / 2});
  EXPECT_GT(awake.processor_s_per_tick, 3 * asleep.processor_s_per_tick);
  ASSERT_FALSE(awake.samples.empty());
  // all deadlines lie on one grid, and no tick comes before its own
  std::int64_t grid_ns = awake.samples.front().time_ns - 1000 * std::int64_t{awake.samples.front().wake_us};
  for (const TipSample& sample : awake.samples) {
    const std::int64_t deadline_ns = sample.time_ns - 1000 * std::int64_t{sample.wake_us};
    const std::int64_t off_ns = (deadline_ns - grid_ns) % kPeriodNs;
    EXPECT_LE(std::min(off_ns, kPeriodNs - off_ns), 1000);
  }
}

TEST(SpinningServo, LeavesHalfOfThePeriodToOthers) {
  SharedSegment segment = create_segment();
  afm::haptics::SimulatedDevice device;
  for (const std::int64_t spin_ns : {std::int64_t{-1}, kPeriodNs / 2 + 1}) {
    const auto loop = afm::haptics::ServoLoop::create(segment, device, {.rate_hz = kRateHz, .spin_ns = spin_ns});
    ASSERT_FALSE(loop);
    EXPECT_THAT(loop.error().message, HasSubstr("choose 0 to 500 us"));
  }
  EXPECT_TRUE(afm::haptics::ServoLoop::create(segment, device, {.rate_hz = kRateHz, .spin_ns = kPeriodNs / 2}));
}

class StoppedServo : public testing::TestWithParam<int> {};

// A debugger, a suspended laptop, a neighbour on the machine.
TEST_P(StoppedServo, GoesOnWithoutAStepOfTheForceAndLetsGoAfterTwentyMilliseconds) {
  constexpr double kLargestStepN = 0.2;
  EXPECT_TRUE(eventually([&] {
    SharedSegment segment = create_segment();
    RendererSide side = segment.renderer_side();
    auto servo = ServoProcess::spawn(kServoProgram, segment, side, {.rate_hz = kRateHz});
    EXPECT_TRUE(servo);
    LiveRenderer renderer(side);
    EXPECT_TRUE(renderer.hold_attached());
    std::vector<TipSample> samples(1);  // last sample before the stop, and all later ones
    while (const auto sample = side.pop_sample()) samples.front() = *sample;
    const std::uint64_t missed_before = side.servo_timing().value_or(ServoTiming{}).missed;

    ::kill((*servo)->pid(), SIGSTOP);
    std::this_thread::sleep_for(milliseconds(GetParam()));
    ::kill((*servo)->pid(), SIGCONT);
    const std::int64_t resumed_ns = now_ns();
    EXPECT_TRUE(renderer.until([&](const TipState& state) { return state.time_ns > resumed_ns + 400'000'000; }));

    while (const auto sample = side.pop_sample()) samples.push_back(*sample);
    const TipState state = tip_state_of(side);
    const std::uint64_t missed = side.servo_timing()->missed - missed_before;
    servo->reset();

    // the machine itself may stall too, and then this was another experiment
    int pauses = 0;
    double largest_step_n = 0;
    std::int64_t longest_ns = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const std::int64_t gap_ns = samples[i].time_ns - samples[i - 1].time_ns;
      pauses += gap_ns > 3 * kPeriodNs ? 1 : 0;
      longest_ns = std::max(longest_ns, gap_ns);
      largest_step_n = std::max(largest_step_n, std::abs(samples[i].hand_force_n - samples[i - 1].hand_force_n));
    }
    if (pauses != 1) return false;

    EXPECT_LE(largest_step_n, kLargestStepN);
    EXPECT_GE(missed, static_cast<std::uint64_t>(longest_ns / kPeriodNs) - 1);
    if (longest_ns > 20'000'000) {
      EXPECT_EQ(state.servo_state, ServoState::Disarmed);
      EXPECT_EQ(state.fault, FaultCode::LateTick);
      EXPECT_EQ(state.hand.force_n, (std::array<double, 3>{}));
    } else {
      EXPECT_EQ(state.servo_state, ServoState::Running);
      EXPECT_LT(state.hand.force_n[1], -0.5);
    }
    std::printf("paused for %.1f ms: largest step %.3f N\n", 1e-6 * static_cast<double>(longest_ns), largest_step_n);
    return (longest_ns > 20'000'000) == (GetParam() > 20);
  }));
}

INSTANTIATE_TEST_SUITE_P(ForMilliseconds, StoppedServo, testing::Values(5, 50, 500), testing::PrintToStringParamName());

}  // namespace servo_timing_test
