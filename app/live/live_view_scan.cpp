// SPDX-License-Identifier: Apache-2.0
// The image that the live window takes of the sample under the tip.
#include <fmt/format.h>

#include <utility>

#include "app/live/live_view.h"
#include "core/log.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scan/scan_subject.h"

namespace afm::app {

void LiveView::toggle_scan() {
  if (scan_) return end_scan();
  const auto material = servo_.material();
  if (!material) return core::log_line("scan: choose a sample first");
  scanned_ = *material;
  scanned_ns_ = clock_.now_ns();
  scan_.emplace(exhibit::scan_subject(stage_.wall_scene, scanned_, felt_[scanned_]));
  panels_.set_scan(&*scan_);
  core::log_line(fmt::format("scan: {}, {:.3g} nm wide, {} lines", stage_.materials.materials[scanned_].title,
                             scan_->subject().side_m * 1e9, exhibit::LiveScan::kPixels));
}

void LiveView::end_scan() {
  if (!scan_) return;
  panels_.set_scan(nullptr);
  scan_.reset();
  core::log_line("scan: ended");
}

void LiveView::toggle_truth() {
  if (!scan_) return core::log_line("scan: press I first");
  scan_->show_truth(!scan_->progress().truth);
  core::log_line(scan_->progress().truth ? "scan: showing what the tip could not reach" : "scan: showing the retrace");
}

// In the frame loop: what a frame has to do is a fraction of a millisecond, and bounded however late the frame is.
void LiveView::follow_scan(std::int64_t now_ns) {
  if (!scan_) return;
  if (const auto material = servo_.material(); material && *material != scanned_) {
    end_scan();
    return toggle_scan();
  }
  scan_->advance(static_cast<double>(now_ns - std::exchange(scanned_ns_, now_ns)) * 1e-9);
}

void LiveView::mark_next_setting() {
  if (const auto material = servo_.material()) panels_.mark_next(*material);
}

void LiveView::step_setting(int steps) {
  if (const auto material = servo_.material()) {
    panels_.step_marked(steps, *material, servo_.running() ? &servo_.link() : nullptr);
  }
}

}  // namespace afm::app
