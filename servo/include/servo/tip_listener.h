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

// Receiver of every sample and event, in order. Called by one thread; must not block.
class TipAudience {
 public:
  TipAudience() = default;
  TipAudience(const TipAudience&) = delete;
  TipAudience& operator=(const TipAudience&) = delete;
  virtual ~TipAudience() = default;
  virtual void heard(const scene::TipSample& sample) = 0;
  virtual void heard(const scene::TipEvent& event) = 0;
};

// Receives every sample and event of a servo within about 2 ms, however slow the frame loop is, passes them to an
// audience, and then to the frame loop in order. Nothing changes for the servo: its rings still have one consumer.
class TipListener {
 public:
  // `side` may have no other user; the segment and the audience must outlive this object. The audience must not throw.
  TipListener(scene::RendererSide side, TipAudience& audience);
  TipListener(const TipListener&) = delete;
  TipListener& operator=(const TipListener&) = delete;
  ~TipListener();

  // Called by the frame loop's thread.
  std::optional<scene::TipSample> pop_sample() noexcept { return handed_on_->samples.pop(); }
  std::optional<scene::TipEvent> pop_event() noexcept { return handed_on_->events.pop(); }
  std::uint64_t lost_samples() const noexcept { return handed_on_->samples.dropped(); }

 private:
  struct HandedOn {
    core::SpscRing<scene::TipSample, 16384> samples;  // ring of 16 s at 1 kHz, as in the segment
    core::SpscRing<scene::TipEvent, 4096> events;
  };

  void listen() noexcept;
  void take_events() noexcept;
  void take_all() noexcept;

  scene::RendererSide side_;
  TipAudience& audience_;
  std::unique_ptr<HandedOn> handed_on_ = std::make_unique<HandedOn>();
  std::atomic<bool> ending_{false};
  std::thread thread_;  // last member, because the thread uses all the others
};

}  // namespace afm::servo
