// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "app/frame_builder.h"
#include "app/servo_link.h"
#include "core/clock.h"

namespace afm::app {

// Keeps a slow frame from looking like a dead one: tells the servo that the loop lives, as often as it is called, but
// for no longer than two seconds of one frame. A slow picture is no reason to let go of the hand, one that has stopped
// is. Made at the beginning of each frame.
class FrameBeat {
 public:
  FrameBeat(ServoLink& servo, const core::Clock& clock) : servo_(servo), clock_(clock), start_ns_(clock.now_ns()) {}

  void operator()() const;

 private:
  ServoLink& servo_;
  const core::Clock& clock_;
  std::int64_t start_ns_;
};

// The servo's samples and events in the order of their times: an event may arrive a moment before the sample of its
// tick, and then waits for it.
class TipStream {
 public:
  // Calls `on_event` for each event and `on_sample` for each sample that belongs to a material.
  template <class OnSample, class OnEvent>
  void take(const ServoLink::News& news, OnSample&& on_sample, OnEvent&& on_event) {
    waiting_.insert(waiting_.end(), news.events.begin(), news.events.end());
    auto event = waiting_.begin();
    for (const scene::TipSample& sample : news.samples) {
      if (sample.material < 0) continue;
      for (; event != waiting_.end() && event->time_ns <= sample.time_ns; ++event) {
        if (event->material >= 0) on_event(*event);
      }
      on_sample(sample);
    }
    waiting_.erase(waiting_.begin(), event);
  }

 private:
  std::vector<scene::TipEvent> waiting_;
};

// What the newest state of the tip tells the wall.
Moment moment_of(const scene::TipState& tip, bool retracting);

// Whether the tip is on its way back from the deepest push of its cycle.
bool is_retracting(double z_m, double deepest_z_m);

// "the renderer gave no frame for 250 ms"
const char* reason(scene::FaultCode fault);

}  // namespace afm::app
