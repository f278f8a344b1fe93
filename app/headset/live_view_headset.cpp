// SPDX-License-Identifier: Apache-2.0
// The live window as the mirror of a headset: the runtime's frames, the wearer's sight, and the controller.
#include "app/live/live_view.h"
#include "servo/frame_heartbeat.h"

namespace afm::app {

// A heartbeat says whether anybody sees the picture, as far as that is known when it is sent.
std::function<void()> LiveView::heartbeat() {
  const servo::FrameHeartbeat beat(servo_.link(), clock_);
  if (settings_.headset == nullptr) return beat;
  return [this, beat] {
    using Picture = servo::ServoClient::Picture;
    servo_.link().set_picture(settings_.headset->blind(clock_.now_ns()) ? Picture::Unseen : Picture::Seen);
    beat();
  };
}

void LiveView::follow_headset() {
  ViewHeadset& headset = *settings_.headset;
  const std::function<void()> beat = heartbeat();
  headset.follow(beat);
  beat();
  const std::int64_t now_ns = clock_.now_ns();
  view_wand_.hold(headset.wand(now_ns));
  picture_.look_from(headset.head());

  // the hand that holds the controller feels each ring of light begin
  const auto ring_ns = servo_.cues().begun_ns(now_ns);
  if (ring_ns && ring_ns != felt_ring_ns_) headset.pulse();
  felt_ring_ns_ = ring_ns;
}

}  // namespace afm::app
