// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/shared/tip_blocks.h"
#include "servo/servo_client.h"

namespace afm::servo {

// The servo's samples and events in time order. An event that arrives before the sample of its tick is held back until
// then.
class TipStream {
 public:
  // Calls `on_event` for each event and `on_sample` for each sample that belongs to a material.
  template <class OnSample, class OnEvent>
  void consume(const ServoClient::Update& update, OnSample&& on_sample, OnEvent&& on_event) {
    waiting_.insert(waiting_.end(), update.events.begin(), update.events.end());
    auto event = waiting_.begin();
    for (const scene::TipSample& sample : update.samples) {
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

}  // namespace afm::servo
