// SPDX-License-Identifier: Apache-2.0
// What the live window says, for who hears it too.
#include <string>

#include "app/live/live_view.h"
#include "core/log.h"

namespace afm::app {

std::string LiveView::guidance(const exhibit::Phrases& phrases) const {
  if (!servo_.running()) return exhibit::step_text(phrases, exhibit::Hint::ServoEnded, controls());
  // without a visitor it invites
  if (visitor_.away()) return exhibit::step_text(phrases, exhibit::Hint::ChooseSample, controls());
  if (const auto line = lesson_guidance(phrases)) return *line;
  if (const auto line = scan_guidance(phrases)) return *line;
  return exhibit::guidance_line(phrases, hint_, servo_.link().tip(), controls());
}

// What goes on, for who does not look at it.
void LiveView::follow_sound() {
  sound_.check_card();
  exhibit::Narrator::Step step{.hint = hint_, .guidance = spoken_guidance(), .scan_lines = {}};
  if (!servo_.running()) step.hint = exhibit::Hint::ServoEnded;
  if (scan_) {
    constexpr std::uint32_t kLine = 2 * exhibit::LiveScan::kPixels;  // trace and retrace
    const exhibit::ScanProgress& progress = scan_->progress();
    step.scan_lines = progress.frame * exhibit::LiveScan::kPixels + progress.pixel / kLine;
  }
  sound_.narrator().follow(servo_.link().tip(), step);
}

void LiveView::toggle_picture() {
  blank_ = !blank_;
  core::log_line(blank_ ? "the picture is blank" : "the picture is shown");
  sound_.narrator().note(stage_.phrases()[blank_ ? exhibit::Phrase::PictureBlank : exhibit::Phrase::PictureShown]);
}

}  // namespace afm::app
