// SPDX-License-Identifier: Apache-2.0
#include "app/live/journey_control.h"

#include "app/view/view_choice.h"
#include "app/view/view_parts.h"
#include "core/clock.h"
#include "core/log.h"
#include "exhibit/state/moment.h"

namespace afm::app {

// Starts or leaves the journey. While it travels, the picture's scale differs from the hand's, so there must be no
// force.
void JourneyControl::turn_round() {
  travel_.turn_round(parts_.clock.now_ns());
  core::log_line("the journey of scale was reversed");
  parts_.choice.take_force_away(parts_.clock.now_ns());
}

void JourneyControl::toggle_analogy() {
  analogy_ = !analogy_;
  core::log_line(analogy_ ? "showing Millet's analogy" : "showing the instrument");
}

void JourneyControl::update(const ViewFrame& frame) {
  travel_.update(frame.now_ns);
  if (travel_.away()) parts_.choice.keep_force_away(frame.now_ns);
}

void JourneyControl::add_to_moment(exhibit::Moment& now, ViewFrame& /*frame*/) {
  now.wall.centerpiece = travel_.orders() ? exhibit::Centerpiece::Journey
                         : analogy_       ? exhibit::Centerpiece::Analogy
                                          : exhibit::Centerpiece::Instrument;
  now.wall.journey_orders = travel_.orders().value_or(0.0);
  now.wall.fade = travel_.fade();
}

void JourneyControl::restart(Restart what) {
  if (what != Restart::Visitor) return;
  if (travel_.orders() && travel_.away()) turn_round();
  analogy_ = false;
}

}  // namespace afm::app
