// SPDX-License-Identifier: Apache-2.0
#include "exhibit/words/procedure.h"

namespace afm::exhibit {

namespace {

// True for hints about the force, which are shown at once, and only while they are true.
bool concerns_safety(Hint hint) {
  return hint == Hint::ComingOn || hint == Hint::GoingOff || hint == Hint::PressToGoOn || hint == Hint::ServoEnded;
}

bool needs_force(Hint hint) {
  return hint == Hint::MoveDown || hint == Hint::PressOn || hint == Hint::Pressed || hint == Hint::MoveUp ||
         hint == Hint::LetGo || hint == Hint::GoBeside || hint == Hint::PushAside;
}

}  // namespace

void Procedure::follow_cycles(const scene::TipState& tip, int cycles) {
  const bool running = tip.servo_state == scene::ServoState::Running;
  if (!running || tip.material != material_) let_go_ = reward_due_ = false;
  const bool may_end = running && tip.material == material_ && !pushes_particles(tip);
  if (may_end && cycles > cycles_) let_go_ = reward_due_ = true;
  cycles_ = cycles;
}

Hint Procedure::update(const scene::TipState& tip, const CycleProgress& progress, std::int64_t now_ns) {
  follow_cycles(tip, progress.cycles);
  const Hint step = next_step(tip, {.ascending = progress.ascending, .pressed = progress.pressed, .let_go = let_go_});
  const bool at_once = !shown_ || tip.material != material_ || concerns_safety(step) || concerns_safety(*shown_) ||
                       needs_force(step) != needs_force(*shown_);
  material_ = tip.material;
  if (shown_ && !at_once && now_ns - shown_since_ns_ < kReadableNs) return *shown_;
  const Hint next = reward_due_ && needs_force(step) ? Hint::LetGo : step;
  if (next == Hint::LetGo) reward_due_ = false;
  if (next == Hint::MoveDown) let_go_ = false;  // beginning of the next cycle
  if (shown_ != next) {
    shown_ = next;
    shown_since_ns_ = now_ns;
  }
  return *shown_;
}

}  // namespace afm::exhibit
