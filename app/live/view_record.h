// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/result.h"
#include "servo/frame_log.h"

namespace afm::exhibit {
struct Moment;
}

namespace afm::app {

struct ViewFrame;
struct ViewParts;

// Stores each frame: its wall in the session, and its row in the frame log. Main thread only.
class ViewRecord {
 public:
  // `parts` must outlive it.
  explicit ViewRecord(ViewParts& parts) : parts_(parts) {}

  // Opens the frame log in this file; empty: none.
  core::Result<void> begin(const std::string& frame_log);

  // Stores the current wall, so that it can be drawn again.
  void keep(const exhibit::Moment& now);

  // Call right after the frame was presented.
  void presented(const ViewFrame& frame);

  core::Result<void> finish();

 private:
  ViewParts& parts_;
  std::unique_ptr<servo::FrameLog> frame_log_;
  servo::ServoLateness servo_lateness_;
};

}  // namespace afm::app
