// SPDX-License-Identifier: Apache-2.0
#include "app/live/view_record.h"

#include <utility>

#include "app/display/view_picture.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_controls.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "core/clock.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/scan/live_scan.h"
#include "servo/servo_client.h"

namespace afm::app {

core::Result<void> ViewRecord::begin(const std::string& frame_log) {
  if (frame_log.empty()) return {};
  auto log = servo::FrameLog::create(frame_log, parts_.clock.now_ns());
  if (!log) return tl::unexpected(log.error());
  frame_log_ = std::move(*log);
  return {};
}

void ViewRecord::keep(const exhibit::Moment& now) {
  if (!parts_.servo.recording()) return;
  const servo::ServoClient& servo = parts_.servo.link();
  servo::WallFrame shown = exhibit::wall_frame_of(now, servo.tip().time_ns, parts_.stage.materials.names());
  shown.room_from_sample = servo.room_from_sample();
  const ViewPicture::Viewing viewing = parts_.picture.viewing();
  shown.head = exhibit::pose_of(viewing.head);
  shown.ipd_m = viewing.ipd_m;
  shown.stereo = scene::name_of(viewing.mode);
  shown.eyes_swapped = viewing.order == scene::EyeOrder::Swapped;
  shown.panels = parts_.panels.shown();
  for (const ViewControl* control : parts_.controls) control->add_to_session(shown);
  parts_.servo.record(shown);
}

void ViewRecord::presented(const ViewFrame& frame) {
  servo::FrameRecord record{.begun_ns = frame.now_ns, .presented_ns = parts_.clock.now_ns()};
  for (ViewControl* control : parts_.controls) control->add_to_log(record);
  if (!frame_log_) return;
  const exhibit::DepthReport& depth = parts_.picture.depth();
  if (depth.measured) {
    record.nearest_rad = depth.nearest.crossed_rad;
    record.farthest_rad = depth.farthest.crossed_rad;
  }
  record.ipd_m = parts_.picture.viewing().ipd_m;
  const scene::ServoTiming timing = parts_.servo.link().timing();
  record.servo_late_us = servo_lateness_.since_last(timing);
  record.servo_missed = timing.missed;
  frame_log_->add(record);
}

core::Result<void> ViewRecord::finish() { return frame_log_ ? frame_log_->finish() : core::Result<void>{}; }

}  // namespace afm::app
