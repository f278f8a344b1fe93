// SPDX-License-Identifier: Apache-2.0
#include "app/live/sound_control.h"

#include "app/view/live_sound.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_controls.h"
#include "app/view/view_parts.h"
#include "core/log.h"
#include "exhibit/frame/blank_picture.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scan/live_scan.h"
#include "servo/servo_client.h"

namespace afm::app {

void SoundControl::say_state() { parts_.sound.say_state(parts_.servo.link().tip()); }

void SoundControl::toggle_sound() { parts_.sound.toggle(); }

void SoundControl::toggle_picture() {
  if (parts_.turn.dark) {
    core::log_line("the picture stays dark until the task is done; R begins it again");
    return parts_.sound.narrator().note(parts_.stage.phrases()[exhibit::Phrase::PictureDark]);
  }
  bool& blank = parts_.turn.blank;
  blank = !blank;
  core::log_line(blank ? "the picture is blank" : "the picture is shown");
  const auto note = blank ? exhibit::Phrase::PictureBlank : exhibit::Phrase::PictureShown;
  parts_.sound.narrator().note(parts_.stage.phrases()[note]);
}

void SoundControl::update(const ViewFrame& /*frame*/) {
  parts_.sound.check_card();
  const std::string line = parts_.controls.guidance(parts_.stage.phrases());
  exhibit::Narrator::Step step{.hint = parts_.turn.hint, .guidance = parts_.choice.spoken(line), .scan_lines = {}};
  if (!parts_.servo.running()) step.hint = exhibit::Hint::ServoEnded;
  if (parts_.turn.scan.scan != nullptr) {
    constexpr std::uint32_t kLine = 2 * exhibit::LiveScan::kPixels;  // pixels of trace and retrace together
    const exhibit::ScanProgress& progress = parts_.turn.scan.scan->progress();
    step.scan_lines = progress.frame * exhibit::LiveScan::kPixels + progress.pixel / kLine;
  }
  parts_.sound.narrator().follow(parts_.servo.link().tip(), step);
}

void SoundControl::add_to_picture(render::FrameState& picture, const ViewFrame& /*frame*/) {
  if (parts_.turn.blank || parts_.turn.dark) exhibit::blank(picture, parts_.stage.phrases());
}

void SoundControl::restart(Restart what) {
  if (what == Restart::Servo) parts_.sound.attach(parts_.servo.link(), parts_.choice.felt());
  if (what != Restart::Visitor) return;
  parts_.turn.blank = false;
  parts_.sound.unmute();
}

}  // namespace afm::app
