// SPDX-License-Identifier: Apache-2.0
// What the live window shows instead of the instrument: the journey of scale, and the analogy.
#include "app/live/live_view.h"
#include "core/log.h"

namespace afm::app {

void LiveView::turn_journey_round() {
  travel_.turn_round(clock_.now_ns());
  core::log_line("the journey of scale was reversed");
  take_force_away(clock_.now_ns());
}

void LiveView::toggle_analogy() {
  analogy_ = !analogy_;
  core::log_line(analogy_ ? "showing Millet's analogy" : "showing the instrument");
}

// The picture's scale is not the hand's while it travels: the material is chosen anew, which needs a lift and Turn-On.
void LiveView::take_force_away(std::int64_t now_ns) {
  force_taken_ns_ = now_ns;
  if (const auto current = servo_.material(); current && servo_.running()) {
    servo_.link().choose(static_cast<std::int32_t>(*current), settings_.scale);
  }
}

void LiveView::travel(std::int64_t now_ns) {
  travel_.update(now_ns);
  const scene::ServoState state = servo_.link().tip().servo_state;
  const bool force = state == scene::ServoState::Arming || state == scene::ServoState::Running;
  if (travel_.away() && force && now_ns - force_taken_ns_ > kForceTakenNs) take_force_away(now_ns);
}

}  // namespace afm::app
