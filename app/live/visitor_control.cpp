// SPDX-License-Identifier: Apache-2.0
#include "app/live/visitor_control.h"

#include <glm/geometric.hpp>
#include <utility>

#include "app/display/view_windows.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_controls.h"
#include "app/view/view_hand.h"
#include "app/view/view_parts.h"
#include "app/view/view_pointer.h"
#include "app/view/view_wand.h"
#include "core/log.h"
#include "servo/servo_client.h"

namespace afm::app {

VisitorControl::VisitorControl(ViewParts& parts, double idle_s)
    : parts_(parts), watch_(static_cast<std::int64_t>(idle_s * 1e9)) {}

// Follows the visitors. When one leaves, everything returns to its initial state and the demonstration starts. When
// another arrives, the same happens for that person's hand, before their first press acts.
void VisitorControl::notice(const ViewInput& input, const ViewFrame& frame) {
  const bool pointed = std::exchange(cursor_seen_px_, input.cursor_px) != input.cursor_px;
  const bool wand = std::exchange(wand_seen_ns_, parts_.wand.used_ns()) != parts_.wand.used_ns();
  const bool hand = hand_was_used();
  const auto change = watch_.update(!input.events.empty() || pointed || wand || hand, frame.now_ns);
  if (change == input::IdleWatch::Change::None) return;
  parts_.hand.demonstrate(watch_.away());
  core::log_line(watch_.away() ? "no visitor: the wall demonstrates itself" : "a visitor has arrived");
  parts_.controls.begin_for_visitor();
  // the force on a device's hand is that of the visitor who has just pressed Turn-On
  if (watch_.away() || !parts_.hand.has_own_hand()) parts_.choice.take_force_away(frame.now_ns);
  if (watch_.away() && !parts_.hand.has_own_hand()) demonstrate_next();
}

void VisitorControl::take(const ViewInput& /*input*/, const ViewFrame& /*frame*/) {
  if (!watch_.away() || parts_.hand.has_own_hand()) return;
  if (parts_.hand.person().step() == input::SimulatedPerson::Step::Done) demonstrate_next();
}

// Invites visitors while there is none.
std::optional<std::string> VisitorControl::guidance(const exhibit::Phrases& phrases) const {
  if (!watch_.away()) return std::nullopt;
  return exhibit::step_text(phrases, exhibit::Hint::ChooseSample, parts_.hand.controls(parts_.pointer.kind()));
}

void VisitorControl::demonstrate_next() {
  if (!parts_.servo.running()) return;
  const auto current = parts_.servo.material();
  parts_.choice.choose(current ? (*current + 1) % parts_.choice.felt().size() : 0);
}

bool VisitorControl::hand_was_used() {
  if (!parts_.hand.has_own_hand()) return false;
  constexpr double kMovedM = 5e-3;  // distance greater than the motion of a device that hangs on its springs
  const scene::TipState& tip = parts_.servo.link().tip();
  const bool pressed = std::exchange(presses_seen_, tip.presses) != tip.presses;
  const auto& [x, y, z] = tip.hand.position_m;
  const glm::dvec3 now(x, y, z);
  if (glm::distance(now, hand_seen_m_) < kMovedM) return pressed;
  hand_seen_m_ = now;
  return true;
}

}  // namespace afm::app
