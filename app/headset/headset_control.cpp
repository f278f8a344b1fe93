// SPDX-License-Identifier: Apache-2.0
#include "app/headset/headset_control.h"

#include "app/display/view_headset.h"
#include "app/display/view_picture.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_parts.h"
#include "app/view/view_wand.h"
#include "core/clock.h"
#include "servo/frame_log.h"

namespace afm::app {

HeadsetControl::HeadsetControl(ViewParts& parts, ViewHeadset& headset) : parts_(parts), headset_(headset) {
  parts_.turn.draws_unseen = true;
  parts_.turn.unseen = [this](std::int64_t now_ns) { return headset_.blind(now_ns); };
}

void HeadsetControl::begin_frame() {
  const Beat beat = heartbeat_of(parts_);
  headset_.follow(beat);
  parts_.turn.paced = headset_.wants_picture();
  beat();
  const std::int64_t now_ns = parts_.clock.now_ns();
  parts_.wand.hold(headset_.wand(now_ns));
  parts_.picture.look_from(headset_.head());

  // the hand with the controller feels a pulse when a ring of light begins
  const auto ring_ns = parts_.servo.cues().begun_ns(now_ns);
  if (ring_ns && ring_ns != felt_ring_ns_) headset_.pulse();
  felt_ring_ns_ = ring_ns;
}

void HeadsetControl::add_to_log(servo::FrameRecord& record) {
  record.pose_age_s = headset_.pose_age_s();
  record.headset = headset_.turn_word();
}

}  // namespace afm::app
