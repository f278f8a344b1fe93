// SPDX-License-Identifier: Apache-2.0
#include "app/bench/timed_servo.h"

#include <utility>

#include "haptics/servo_loop.h"

namespace afm::app {

core::Result<std::unique_ptr<TimedServo>> TimedServo::create(const scene::SharedModel& model,
                                                             const scene::Topography& topography,
                                                             scene::ScaleMode mode) {
  auto segment = scene::SharedSegment::create(model, 0, topography);
  if (!segment) return tl::unexpected(segment.error());
  std::unique_ptr<TimedServo> timed(new TimedServo(std::move(*segment), mode));
  auto loop = haptics::ServoLoop::create(timed->segment_, timed->hand_,
                                         {.rate_hz = 1e9 / static_cast<double>(TimedServo::kPeriodNs)});
  if (!loop) return tl::unexpected(loop.error());
  timed->loop_ = std::move(*loop);
  return timed;
}

TimedServo::TimedServo(scene::SharedSegment segment, scene::ScaleMode mode)
    : segment_(std::move(segment)), side_(segment_.renderer_side()) {
  side_.store(scene::Selection{.material = 0, .revision = 1, .scale_mode = mode});
}

TimedServo::~TimedServo() = default;

bool TimedServo::turn_on() {
  constexpr int kLift = 1500, kPress = 100, kRamp = 1400;  // ticks
  for (int i = 0; i < kLift; ++i) tick_us();
  const scene::HandScript lifted{.target_m = {kLiftedM.x, kLiftedM.y, kLiftedM.z}, .duration_s = 0.6};
  scene::HandScript pressed = lifted;
  pressed.turn_on_pressed = 1;
  follow(pressed);
  for (int i = 0; i < kPress; ++i) tick_us();
  follow(lifted);
  for (int i = 0; i < kRamp; ++i) tick_us();
  return state().servo_state == scene::ServoState::Running;
}

void TimedServo::aim(const glm::dvec3& target_m, double seconds) {
  follow({.target_m = {target_m.x, target_m.y, target_m.z}, .duration_s = seconds});
}

void TimedServo::follow(const scene::HandScript& script) {
  const std::uint32_t revision = script_.revision + 1;
  script_ = script;
  script_.revision = revision;
  side_.store(script_);
}

double TimedServo::tick_us() {
  side_.store(scene::RendererHeartbeat{.time_ns = now_ns_, .frame = tick_});
  now_ns_ += kPeriodNs;
  const std::int64_t before_ns = clock_.now_ns();
  loop_->tick(now_ns_, 0);
  const std::int64_t after_ns = clock_.now_ns();
  while (side_.pop_sample()) {
  }
  while (side_.pop_event()) {
  }
  ++tick_;
  return 1e-3 * static_cast<double>(after_ns - before_ns);
}

}  // namespace afm::app
