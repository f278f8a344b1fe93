// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

#include "core/clock.h"
#include "core/result.h"
#include "haptics/simulated_device.h"
#include "scene/shared/shared_segment.h"

namespace afm::haptics {
class ServoLoop;
}

namespace afm::app {

// A servo loop with the simulated hand, in simulated time at 1 kHz. Times every tick. One thread.
class TimedServo {
 public:
  static constexpr std::int64_t kPeriodNs = 1'000'000;
  static constexpr glm::dvec3 kLiftedM{0.03, 0.060, 0.03};  // place of the hand after turn_on()

  // Selects the first material of a valid model at a scale.
  static core::Result<std::unique_ptr<TimedServo>> create(const scene::SharedModel& model,
                                                          const scene::Topography& topography = {},
                                                          scene::ScaleMode mode = scene::ScaleMode::Fit);
  ~TimedServo();

  // Makes the simulated person lift the hand and press Turn-On; takes 3000 ticks, with the ramp of the force. False:
  // the force was not enabled.
  bool turn_on();

  // Sends the hand to a place, in metres, device frame, +y up.
  void aim(const glm::dvec3& target_m, double seconds);
  bool arrived() { return state().acknowledged.hand_script == script_.revision; }

  // Runs one tick and returns its duration.
  double tick_us();

  scene::TipState state() { return *side_.tip_state(); }
  scene::TipPush push() { return side_.tip_push().value_or(scene::TipPush{}); }

 private:
  TimedServo(scene::SharedSegment segment, scene::ScaleMode mode);

  void follow(const scene::HandScript& script);

  scene::SharedSegment segment_;
  scene::RendererSide side_;
  haptics::SimulatedDevice hand_;
  std::unique_ptr<haptics::ServoLoop> loop_;
  core::MonotonicClock clock_;
  scene::HandScript script_{};
  std::int64_t now_ns_ = kPeriodNs;
  std::uint64_t tick_ = 0;
};

}  // namespace afm::app
