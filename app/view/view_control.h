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
struct WallFrame;
}  // namespace afm::servo

namespace afm::app {

struct ViewInput;

// One frame of the live window. Some fields are filled while the frame is processed.
struct ViewFrame {
  std::int64_t now_ns = 0;                               // beginning of the frame
  double frame_s = 0;                                    // time since the beginning of the previous frame
  Pointed pointed{};                                     // pointer's target; set after update()
  std::string caption{};                                 // text of the newest sound; set after update()
  exhibit::Relief relief = exhibit::Relief::NarrowEyes;  // advice for a depth that strains the eyes
};

// Extent of a restart.
enum class Restart {
  Servo,       // replaced servo
  Everything,  // return of the wall to its initial state
  Visitor      // same for another visitor, including everything that only a person can change
};

// A feature of the live window, with its own state. The loop calls all controls in order and does not know their types.
// Each overrides the calls that it needs, listed in the order of a frame. Main thread only.
class ViewControl {
 public:
  using Beat = std::function<void()>;  // heartbeat of the frame, to be called often during waits

  virtual ~ViewControl() = default;

  // Called before the frame's time is taken; may wait.
  virtual void begin_frame() {}

  // Called before anything acts on the input, and again before a press of the wand acts.
  virtual void notice(const ViewInput& /*input*/, const ViewFrame& /*frame*/) {}

  // Called before the hand moves and the servo's new samples are read.
  virtual void take(const ViewInput& /*input*/, const ViewFrame& /*frame*/) {}

  // Called with the servo's newest state.
  virtual void update(const ViewFrame& /*frame*/) {}

  // Adds the control's content to the wall, or hides other content.
  virtual void add_to_moment(exhibit::Moment& /*now*/, ViewFrame& /*frame*/) {}

  // Line of guidance, or empty. The first control with a line wins.
  virtual std::optional<std::string> guidance(const exhibit::Phrases& /*phrases*/) const { return std::nullopt; }

  // Adds the control's state for the session, in addition to the moment; called while one is recorded.
  virtual void add_to_session(servo::WallFrame& /*shown*/) const {}

  // Changes the picture after the panels have been added.
  virtual void add_to_picture(render::FrameState& /*picture*/, const ViewFrame& /*frame*/) {}

  // Called after drawing and before showing; may wait.
  virtual void before_showing(const Beat& /*beat*/) {}

  // Called when the windows show the frame.
  virtual void shown(const ViewFrame& /*frame*/, const Beat& /*beat*/) {}

  // Adds figures to the frame's row in the frame log.
  virtual void add_to_log(servo::FrameRecord& /*record*/) {}

  // Called between frames.
  virtual void restart(Restart /*what*/) {}

  // Called after the last frame, while the servo still runs.
  virtual void finish() {}
};

}  // namespace afm::app
