// SPDX-License-Identifier: Apache-2.0
// The live window that nobody attends.
#include <glm/geometric.hpp>
#include <utility>

#include "app/live/live_view.h"
#include "core/log.h"

namespace afm::app {

// A visitor has gone: everything as after the start, and the wall shows what it does. Another has come: the same, for
// that one's hand.
void LiveView::follow_visitor(const ViewInput& input, std::int64_t now_ns) {
  const bool pointed = std::exchange(cursor_seen_px_, input.cursor_px) != input.cursor_px;
  const bool wand = std::exchange(wand_seen_ns_, view_wand_.used_ns()) != view_wand_.used_ns();
  const bool hand = hand_was_used();
  const auto change = visitor_.update(!input.events.empty() || pointed || wand || hand, now_ns);
  if (change == input::IdleWatch::Change::None) {
    if (visitor_.away() && !has_own_hand() && person_.step() == input::SimulatedPerson::Step::Done) demonstrate_next();
    return;
  }
  core::log_line(visitor_.away() ? "no visitor: the wall demonstrates itself" : "a visitor has arrived");
  begin_for_visitors();
  take_force_away(now_ns);
  if (visitor_.away() && !has_own_hand()) demonstrate_next();
}

void LiveView::begin_for_visitors() {
  if (travel_.orders() && travel_.away()) turn_journey_round();
  analogy_ = false;
  blank_ = false;
  sound_.unmute();
  panels_.show("samples");
  bring_home();
  begin_again();
}

void LiveView::demonstrate_next() {
  if (!servo_.running()) return;
  const std::size_t next = servo_.material() ? (*servo_.material() + 1) % swatches_.size() : 0;
  choose(next);
}

bool LiveView::hand_was_used() {
  if (!has_own_hand()) return false;
  constexpr double kMovedM = 5e-3;  // more than a device that hangs on its springs
  const auto& [x, y, z] = servo_.link().tip().hand.position_m;
  const glm::dvec3 now(x, y, z);
  if (glm::distance(now, hand_seen_m_) < kMovedM) return false;
  hand_seen_m_ = now;
  return true;
}

}  // namespace afm::app
