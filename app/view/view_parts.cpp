// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_parts.h"

#include "app/view/servo_supervisor.h"
#include "servo/frame_heartbeat.h"

namespace afm::app {

std::function<void()> heartbeat_of(ViewParts& parts) {
  const servo::FrameHeartbeat beat(parts.servo.link(), parts.clock);
  if (!parts.turn.unseen) return beat;
  return [&parts, beat] {
    using Picture = servo::ServoClient::Picture;
    parts.servo.link().set_picture(parts.turn.unseen(parts.clock.now_ns()) ? Picture::Unseen : Picture::Seen);
    beat();
  };
}

}  // namespace afm::app
