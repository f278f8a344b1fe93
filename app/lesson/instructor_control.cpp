// SPDX-License-Identifier: Apache-2.0
#include "app/lesson/instructor_control.h"

#include <utility>

#include "app/display/instructor_window.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_parts.h"
#include "core/log.h"
#include "exhibit/lesson/live_lesson.h"
#include "exhibit/state/moment.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

constexpr std::int64_t kAskedNs = 10'000'000'000;  // longest time between the two presses of Stop

}  // namespace

InstructorControl::InstructorControl(ViewParts& parts, exhibit::LiveLesson& lesson, InstructorWindow& window,
                                     std::function<void(render::Key)> press_key)
    : parts_(parts), lesson_(lesson), window_(window), press_key_(std::move(press_key)) {}

void InstructorControl::take(const ViewInput& /*input*/, const ViewFrame& frame) {
  const InstructorWindow::Input input = window_.poll(lesson_.prompt());
  for (const exhibit::InstructorAction action : input.actions) act(action, frame.now_ns);
  for (const render::Key key : input.keys) press(key);
  parts_.turn.leaving = parts_.turn.leaving || input.close_requested;
  if (stop_asked_ns_ && frame.now_ns - *stop_asked_ns_ > kAskedNs) stop_asked_ns_.reset();
  if (hand_off_) parts_.choice.stop_force();
}

// Handles a key. Enter is only Stop: at the wall it would also answer for the participant.
void InstructorControl::press(render::Key key) {
  if (key != render::Key::Enter) return press_key_(key);
  parts_.choice.stop_force();
}

void InstructorControl::act(exhibit::InstructorAction action, std::int64_t now_ns) {
  using exhibit::InstructorAction;
  const bool asked = std::exchange(stop_asked_ns_, std::nullopt).has_value();
  switch (action) {
    case InstructorAction::Next:
      return lesson_.next();
    case InstructorAction::Skip:
      return lesson_.skip();
    case InstructorAction::Stop:
      if (!asked) {
        stop_asked_ns_ = now_ns;
        return core::log_line("instructor: press Stop again to end the lesson");
      }
      core::log_line("instructor: the lesson is stopped");
      return lesson_.stop();
    case InstructorAction::HandOff:
      hand_off_ = !hand_off_;
      core::log_line(hand_off_ ? "instructor: the force is off" : "instructor: the force is allowed again");
      break;
  }
}

void InstructorControl::shown(const ViewFrame& frame, const Beat& beat) {
  exhibit::InstructorState state = lesson_.instructor_state();
  state.hand = parts_.servo.running() ? parts_.servo.link().tip().servo_state : scene::ServoState::Fault;
  state.stopped = parts_.servo.running() && exhibit::is_stopped(parts_.servo.link().tip());
  state.hand_off = hand_off_;
  state.stop_asked = stop_asked_ns_.has_value();
  window_.show(state, frame.now_ns, beat);
}

}  // namespace afm::app
