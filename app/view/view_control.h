// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "app/view/pointed.h"
#include "exhibit/panels/depth_report.h"

namespace afm::exhibit {
struct Moment;
}
namespace afm::servo {
struct FrameRecord;
}

namespace afm::app {

struct ViewInput;

// One frame of the live window, as far as it is known.
struct ViewFrame {
  std::int64_t now_ns = 0;                               // its beginning
  double frame_s = 0;                                    // time since the beginning of the previous frame
  Pointed pointed{};                                     // set after update()
  std::string caption{};                                 // text for what is heard; set after update()
  exhibit::Relief relief = exhibit::Relief::NarrowEyes;  // advice if the depth is hard to look at
};

// What starts again.
enum class Restart {
  Servo,       // another servo has been started
  Everything,  // the wall goes back to its state after the start
  Visitor      // the same for another visitor: what only a person can have changed
};

// A feature of the live window, with its own state. The loop calls all controls in their order and knows none of them.
// Each overrides what it needs; the calls are listed in the order of a frame. Main thread only.
class ViewControl {
 public:
  using Beat = std::function<void()>;  // the frame's heartbeat, to be called often while something waits

  virtual ~ViewControl() = default;

  // Before the time of the frame is taken; may wait.
  virtual void begin_frame() {}

  // Before the hand moves and the servo's news come.
  virtual void take(const ViewInput& /*input*/, const ViewFrame& /*frame*/) {}

  // With the servo's newest state.
  virtual void update(const ViewFrame& /*frame*/) {}

  // Adds what it shows on the wall, or hides it.
  virtual void add_to_moment(exhibit::Moment& /*now*/, ViewFrame& /*frame*/) {}

  // The line of guidance, if this control has one; the first control that has one decides.
  virtual std::optional<std::string> guidance(const exhibit::Phrases& /*phrases*/) const { return std::nullopt; }

  // Changes the picture after the panels were added.
  virtual void add_to_picture(render::FrameState& /*picture*/, const ViewFrame& /*frame*/) {}

  // Everything is drawn and not yet shown; may wait.
  virtual void before_showing(const Beat& /*beat*/) {}

  // The windows show the frame.
  virtual void shown(const ViewFrame& /*frame*/, const Beat& /*beat*/) {}

  // Adds its figures to the frame's row in the frame log.
  virtual void add_to_log(servo::FrameRecord& /*record*/) {}

  // Between the calls of a frame.
  virtual void restart(Restart /*what*/) {}

  // After the last frame, while the servo still runs.
  virtual void finish() {}
};

}  // namespace afm::app
