// SPDX-License-Identifier: Apache-2.0
// What the live window has to do with the other machines of its wall.
#include "app/live/live_view.h"
#include "exhibit/cluster/frame_digest.h"
#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/scan/scan_panels.h"

namespace afm::app {

// Sends the inputs of this frame, and returns the moment as the others have it: what had no room is missing here too.
exhibit::Moment LiveView::share(const exhibit::Moment& now, const Pointed& pointed, cluster::FrameMessage& message) {
  exhibit::set_moment(now, servo_.link().tip(), sound_.narrator().caption(), blank_, message);
  message.panels = panels_.told(pointed, hand());
  message.view = picture_.told();
  share_scan();
  cluster_->send(message, panels_.edits(), servo_.cycles(), servo_.friction());
  exhibit::Moment shared = exhibit::moment_of(message);
  shared.curves = now.curves;
  if (scan_) exhibit::show_scan(*scan_, shared);
  return shared;
}

void LiveView::share_scan() {
  if (cluster_ != nullptr) cluster_->follow_scan(scan_ ? &*scan_ : nullptr, scanned_, scans_);
}

void LiveView::share_built(const cluster::FrameMessage& message, render::FrameState& frame) {
  add_warning(missing_text(message.missing, stage_.wall, stage_.phrases()), frame.panels.banner.content);
  cluster_->built(exhibit::digest_of(frame, message.view));
}

}  // namespace afm::app
