// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>

#include "core/spsc_ring.h"
#include "scene/shared/shared_segment.h"
#include "scene/shared/tip_blocks.h"

namespace afm::servo {

// Who hears of every sample and event, in their order. One thread calls it; it may not block.
class TipAudience {
 public:
  TipAudience() = default;
  TipAudience(const TipAudience&) = delete;
  TipAudience& operator=(const TipAudience&) = delete;
  virtual ~TipAudience() = default;
  virtual void heard(const scene::TipSample& sample) = 0;
  virtual void heard(const scene::TipEvent& event) = 0;
};

// Takes every sample and event of a servo within some 2 ms, whatever the frame loop does, gives them to an audience,
// and hands them on to the frame loop in their order. The servo does not notice: its rings have one consumer as before.
class TipListener {
 public:
  // `side` for this alone; the segment and the audience must outlive it. The audience may not throw.
  TipListener(scene::RendererSide side, TipAudience& audience);
  TipListener(const TipListener&) = delete;
  TipListener& operator=(const TipListener&) = delete;
  ~TipListener();

  // The frame loop's thread.
  std::optional<scene::TipSample> pop_sample() noexcept { return handed_on_->samples.pop(); }
  std::optional<scene::TipEvent> pop_event() noexcept { return handed_on_->events.pop(); }
  std::uint64_t lost_samples() const noexcept { return handed_on_->samples.dropped(); }

 private:
  struct HandedOn {
    core::SpscRing<scene::TipSample, 16384> samples;  // 16 s, as in the segment
    core::SpscRing<scene::TipEvent, 4096> events;
  };

  void listen() noexcept;
  void take_events() noexcept;
  void take_all() noexcept;

  scene::RendererSide side_;
  TipAudience& audience_;
  std::unique_ptr<HandedOn> handed_on_ = std::make_unique<HandedOn>();
  std::atomic<bool> ending_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace afm::servo
