// SPDX-License-Identifier: Apache-2.0
// Whose head the live window is drawn for, and what is kept of each frame.
#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "app/live/live_view.h"
#include "core/log.h"
#include "exhibit/recorded_wall.h"

namespace afm::app {

void LiveView::follow_head(std::int64_t now_ns) {
  auto seen = view_wand_.head();
  if (!view_wand_.tracks_head()) {
    if (const auto simulated = simulated_head_.pose(now_ns)) seen = {.pose = *simulated, .time_ns = now_ns};
  }
  const auto pose = seen ? std::optional(seen->pose) : std::nullopt;
  if (const auto head = head_.update(pose, seen ? seen->time_ns : 0, now_ns)) picture_.look_from(*head);
}

void LiveView::move_head(double right_m, double up_m, double nearer_m) {
  if (view_wand_.tracks_head()) {
    core::log_line("the tracker controls the head; the arrow keys have no effect");
    return;
  }
  const scene::Screen& screen = stage_.screen;
  const glm::dvec3 right = glm::normalize(screen.lower_right - screen.lower_left), normal = screen.normal();
  simulated_head_.step(right_m * right + up_m * glm::cross(normal, right) - nearer_m * normal);
  core::log_line(fmt::format("head: {:+.2f} m to the right, {:+.2f} m up, {:+.2f} m nearer", right_m, up_m, nearer_m));
}

// So that the wall can be drawn again as it is now.
void LiveView::record(const exhibit::Moment& now) {
  if (!servo_.recording()) return;
  servo::WallFrame shown = exhibit::wall_frame_of(now, servo_.link().tip().time_ns, stage_.materials.names());
  shown.room_from_sample = servo_.link().room_from_sample();
  const ViewPicture::Viewing viewing = picture_.viewing();
  shown.head = exhibit::pose_of(viewing.head);
  shown.ipd_m = viewing.ipd_m;
  shown.stereo = scene::name_of(viewing.mode);
  shown.eyes_swapped = viewing.order == scene::EyeOrder::Swapped;
  shown.panels = panels_.shown();
  servo_.record(shown);
}

void LiveView::log_frame(std::int64_t begun_ns, std::int64_t presented_ns, std::optional<double> head_latency_s) {
  if (!frame_log_) return;
  const scene::ServoTiming timing = servo_.link().timing();
  const exhibit::DepthReport& depth = picture_.depth();
  const bool measured = depth.measured;
  frame_log_->add({.begun_ns = begun_ns,
                   .presented_ns = presented_ns,
                   .head_latency_s = head_latency_s,
                   .nearest_rad = measured ? std::optional(depth.nearest.crossed_rad) : std::nullopt,
                   .farthest_rad = measured ? std::optional(depth.farthest.crossed_rad) : std::nullopt,
                   .ipd_m = picture_.viewing().ipd_m,
                   .servo_late_us = servo_lateness_.since_last(timing),
                   .servo_missed = timing.missed,
                   .pose_age_s = settings_.headset == nullptr ? std::nullopt : settings_.headset->pose_age_s(),
                   .headset = settings_.headset == nullptr ? "" : settings_.headset->turn_word()});
}

}  // namespace afm::app
