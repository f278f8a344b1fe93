// SPDX-License-Identifier: Apache-2.0
#include "app/view/view_controls.h"

#include "app/view/live_sound.h"
#include "app/view/parameter_edits.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_hand.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "app/view/view_pointer.h"
#include "core/log.h"
#include "servo/servo_client.h"

namespace afm::app {

void ViewControls::servo_started(servo::ServoClient& servo, std::optional<std::size_t> chosen_before) {
  for (ViewControl* control : controls_) control->restart(Restart::Servo);
  parts_.hand.renew_mouse();
  parts_.panels.edits().resend(servo);
  parts_.choice.choose_first(chosen_before);
}

void ViewControls::begin_again() {
  parts_.servo.forget_cycles();
  for (ViewControl* control : controls_) control->restart(Restart::Everything);
  parts_.hand.mouse().lift();
  if (parts_.servo.running()) {
    parts_.panels.edits().reset(parts_.servo.link());
  } else if (auto started = parts_.servo.start(); !started) {
    core::log_line(started.error().message);
  }
}

void ViewControls::begin_for_visitor() {
  for (ViewControl* control : controls_) control->restart(Restart::Visitor);
  parts_.panels.show("samples");
  begin_again();
}

std::string ViewControls::guidance(const exhibit::Phrases& phrases) const {
  const exhibit::Controls held = parts_.hand.controls(parts_.pointer.kind());
  if (!parts_.servo.running()) return exhibit::step_text(phrases, exhibit::Hint::ServoEnded, held);
  for (const ViewControl* control : controls_) {
    if (auto line = control->guidance(phrases)) return *std::move(line);
  }
  return exhibit::guidance_line(phrases, parts_.turn.hint, parts_.servo.link().tip(), held);
}

}  // namespace afm::app
