// SPDX-License-Identifier: Apache-2.0
// Invariant: events are heard at their own times within 30 ms, however slow the picture
#include "servo/tip_listener.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "scene/shared/shared_segment.h"
#include "servo/servo_client.h"
#include "servo/tip_stream.h"
#include "support/paper_model.h"

namespace afm::servo {
namespace tip_listener_test {

// Counts, and notes any event that comes after the sample of its tick.
class Counting final : public TipAudience {
 public:
  void heard(const scene::TipSample& sample) noexcept override {
    last_ns_ = sample.time_ns;
    ++samples;
  }
  void heard(const scene::TipEvent& event) noexcept override {
    if (event.time_ns < last_ns_) ++late;
    ++events;
  }
  std::atomic<int> samples{0}, events{0}, late{0};

 private:
  std::int64_t last_ns_ = 0;
};

constexpr int kTicks = 5000, kEventEvery = 7;

void push_ticks(scene::ServoSide& servo) {
  for (int tick = 1; tick <= kTicks; ++tick) {
    const std::int64_t now_ns = tick * 1'000'000LL;
    if (tick % kEventEvery == 0) {
      servo.push(scene::TipEvent{.kind = physics::EventKind::Slip, .material = 0, .time_ns = now_ns - 300'000});
    }
    scene::TipSample sample{.time_ns = now_ns, .tick = static_cast<std::uint64_t>(tick)};
    sample.material = 0;
    servo.push(sample);
    if (tick % 50 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(TipListener, HearsAllWhileNoFrameIsDrawnAndHandsItOnInOrder) {
  auto segment = scene::SharedSegment::create(test::paper_model(), 0, {}).value();
  scene::ServoSide servo = segment.servo_side();
  Counting audience;
  TipListener listener(segment.renderer_side(), audience);
  push_ticks(servo);
  for (int i = 0; i < 5000 && audience.samples < kTicks; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(audience.samples, kTicks) << "nobody has polled";
  EXPECT_EQ(audience.events, kTicks / kEventEvery);
  EXPECT_EQ(audience.late, 0);

  ServoClient::Update update;
  while (const auto sample = listener.pop_sample()) update.samples.push_back(*sample);
  while (const auto event = listener.pop_event()) update.events.push_back(*event);
  ASSERT_EQ(update.samples.size(), static_cast<std::size_t>(kTicks));
  EXPECT_EQ(update.events.size(), static_cast<std::size_t>(kTicks / kEventEvery));
  EXPECT_EQ(listener.lost_samples(), 0U);
  for (int tick = 1; tick <= kTicks; ++tick) {
    ASSERT_EQ(update.samples[static_cast<std::size_t>(tick - 1)].tick, static_cast<std::uint64_t>(tick));
  }
}

TEST(TipListener, GivesTheFrameLoopEventsBeforeTheSamplesOfTheirTicks) {
  auto segment = scene::SharedSegment::create(test::paper_model(), 0, {}).value();
  scene::ServoSide servo = segment.servo_side();
  Counting audience, frames;
  TipListener listener(segment.renderer_side(), audience);
  std::thread ticks([&] { push_ticks(servo); });
  TipStream stream;
  for (int i = 0; i < 10'000 && frames.samples < kTicks; ++i) {
    ServoClient::Update update;
    while (const auto sample = listener.pop_sample()) update.samples.push_back(*sample);
    while (const auto event = listener.pop_event()) update.events.push_back(*event);
    stream.consume(
        update, [&](const scene::TipSample& sample) { frames.heard(sample); },
        [&](const scene::TipEvent& event) { frames.heard(event); });
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ticks.join();
  EXPECT_EQ(frames.samples, kTicks);
  EXPECT_EQ(frames.events, kTicks / kEventEvery);
  EXPECT_EQ(frames.late, 0);
}

}  // namespace tip_listener_test
}  // namespace afm::servo
