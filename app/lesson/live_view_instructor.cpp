// SPDX-License-Identifier: Apache-2.0
// The instructor of a lesson, at a window of their own.
#include <utility>

#include "app/live/live_view.h"
#include "core/log.h"

namespace afm::app {

namespace {

constexpr std::int64_t kAskedNs = 10'000'000'000;  // until a Stop that was pressed once is forgotten

}  // namespace

void LiveView::follow_instructor(std::int64_t now_ns) {
  if (instructor_ == nullptr || lesson_ == nullptr) return;
  const InstructorWindow::Input input = instructor_->poll(lesson_->prompt());
  for (const exhibit::InstructorAction action : input.actions) instruct(action, now_ns);
  for (const render::Key key : input.keys) press_key(key);
  leaving_ = leaving_ || input.close_requested;
  if (stop_asked_ns_ && now_ns - *stop_asked_ns_ > kAskedNs) stop_asked_ns_.reset();
  if (hand_off_) stop_force();
}

void LiveView::instruct(exhibit::InstructorAction action, std::int64_t now_ns) {
  using exhibit::InstructorAction;
  const bool asked = std::exchange(stop_asked_ns_, std::nullopt).has_value();
  switch (action) {
    case InstructorAction::Next:
      return lesson_->next();
    case InstructorAction::Skip:
      return lesson_->skip();
    case InstructorAction::Stop:
      if (!asked) {
        stop_asked_ns_ = now_ns;
        return core::log_line("instructor: press Stop again to end the lesson");
      }
      core::log_line("instructor: the lesson is stopped");
      return lesson_->stop();
    case InstructorAction::HandOff:
      hand_off_ = !hand_off_;
      core::log_line(hand_off_ ? "instructor: the force is off" : "instructor: the force is allowed again");
      break;
  }
}

void LiveView::show_to_instructor(std::int64_t now_ns, const std::function<void()>& while_waiting) {
  if (instructor_ == nullptr || lesson_ == nullptr) return;
  exhibit::InstructorState state = lesson_->instructor_state();
  state.hand = servo_.running() ? servo_.link().tip().servo_state : scene::ServoState::Fault;
  state.hand_off = hand_off_;
  state.stop_asked = stop_asked_ns_.has_value();
  instructor_->show(state, now_ns, while_waiting);
}

}  // namespace afm::app
