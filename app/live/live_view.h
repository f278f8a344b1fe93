// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "app/live/view_record.h"
#include "core/result.h"
#include "exhibit/words/procedure.h"
#include "render/key.h"

namespace afm::exhibit {
class FrameBuilder;
}

namespace afm::app {

struct ViewEvent;
struct ViewInput;

// The loop of the live window: takes the input, moves the hand, follows the servo, and shows its newest state in every
// frame. The controls of `parts` do everything else. Main thread only.
class LiveView {
 public:
  struct Settings {
    double most_frames_per_s = 60.0;
    std::string frame_log;    // file name; empty: no log
    bool unattended = false;  // true: closing a window does not end the loop
  };

  // `press_key` receives every key press. All arguments must outlive the object.
  LiveView(ViewParts& parts, std::function<void(render::Key)> press_key, Settings settings);
  ~LiveView();

  // Runs until a window is closed, a control leaves, or SIGINT or SIGTERM arrives. Fails if the servo cannot be
  // started, at the end if it has died and was not restarted, and at once, after ending the servo cleanly, if the
  // graphics device or the display is lost.
  core::Result<void> run();

 private:
  void run_frame(std::int64_t now_ns);
  void notice(const ViewInput& input, const ViewFrame& frame);
  void handle(const ViewEvent& input, std::int64_t now_ns);
  void move_hand(const ViewInput& input, const ViewFrame& frame);
  void follow_wand(const ViewInput& input, const ViewFrame& frame);
  exhibit::Hint next_hint(std::int64_t now_ns);
  exhibit::Moment moment(ViewFrame& frame);
  void draw(const ViewInput& input, ViewFrame& frame);
  void log_guidance();
  void pace(std::int64_t frame_start_ns) const;

  ViewParts& parts_;
  std::function<void(render::Key)> press_key_;
  Settings settings_;
  std::unique_ptr<exhibit::FrameBuilder> frames_;
  exhibit::Procedure procedure_;
  ViewRecord record_;
  std::string logged_guidance_;
  std::int64_t frame_ns_ = 0;  // beginning of the newest frame
};

}  // namespace afm::app
