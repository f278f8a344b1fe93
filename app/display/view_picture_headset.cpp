// SPDX-License-Identifier: Apache-2.0
// Part of ViewPicture for a headset, whose left eye the window mirrors.
#include "app/display/view_headset.h"
#include "app/display/view_picture.h"
#include "exhibit/frame/exhibit_setup.h"

namespace afm::app {

namespace {

// Interval longer than a frame of any display, so that the headset never waits for the window.
constexpr std::int64_t kMirrorNs = 33'000'000;

}  // namespace

void ViewPicture::show_in_headset(render::FrameState& frame, std::int64_t now_ns,
                                  const std::function<void()>& while_waiting) {
  ViewHeadset& headset = *settings_.headset;
  // last, so that the eyes' pose is as new as possible
  renderer_.wait_until_ready(while_waiting);
  const MirroredEye seen = headset.locate_eyes(while_waiting);
  frame.eyes = seen.eyes;
  frame.panels_apart = headset.panels_apart();
  renderer_.render(frame);
  headset.show();
  if (headset.wants_picture()) {
    times_.shown(now_ns);
  } else {
    times_.hidden();
  }
  Share& share = shares_.front();
  share.eyes = seen.eyes;
  share.screen = seen.screen;
  const bool mirrors = now_ns - mirrored_ns_ >= kMirrorNs;
  if ((mirrors || to_save_ > 0) && frame.panels_apart > 0) {
    // window and screenshots show the eyes' pictures and so need all panels in them
    frame.panels_apart = 0;
    renderer_.wait_until_ready(while_waiting);
    renderer_.render(frame);
  }
  save_newest();
  while_waiting();
  if (!mirrors) return;
  mirrored_ns_ = now_ns;
  mirror(while_waiting);
}

void ViewPicture::mirror(const std::function<void()>& while_waiting) {
  if (!presenter_.begin(pictures_, while_waiting)) return;
  presenter_.draw(shares_.front().windows, while_waiting);
  presenter_.show();
  while_waiting();
}

}  // namespace afm::app
