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
         hint == Hint::LetGo || hint == Hint::GoBeside || hint == Hint::PushAside || hint == Hint::TakeSwing ||
         hint == Hint::GiveSwing || hint == Hint::SwingsFree;
}

// Beginning of the next cycle.
bool begins_again(Hint hint) { return hint == Hint::MoveDown || hint == Hint::TakeSwing; }

// Shares of the free amplitude below which the sample has taken the swing, and above which the lever is free again. The
// stroke ends at a tenth.
constexpr double kTakenShare = 0.25, kFreeShare = 0.9;

}  // namespace

void Procedure::follow_cycles(const scene::TipState& tip, int cycles) {
  const bool running = tip.servo_state == scene::ServoState::Running;
  if (!running || tip.material != material_) let_go_ = reward_due_ = false;
  const bool may_end = running && tip.material == material_ && !pushes_particles(tip);
  if (may_end && cycles > cycles_) let_go_ = reward_due_ = true;
  cycles_ = cycles;
}

// A cycle of a lever that taps ends when it swings freely again, whether or not it had fallen into the repulsive state.
void Procedure::follow_swing(const scene::TipState& tip, std::optional<double> share) {
  const bool running = tip.servo_state == scene::ServoState::Running && tip.material == material_;
  if (!share || !running) {
    swing_taken_ = false;
    return;
  }
  if (*share <= kTakenShare) swing_taken_ = true;
  if (swing_taken_ && *share >= kFreeShare) {
    swing_taken_ = false;
    let_go_ = reward_due_ = true;
  }
}

Hint Procedure::update(const scene::TipState& tip, const CycleProgress& progress, std::int64_t now_ns) {
  const std::optional<double> share = progress.swing_share;
  follow_cycles(tip, share ? cycles_ : progress.cycles);
  follow_swing(tip, share);
  StepsDone done{.ascending = progress.ascending, .pressed = progress.pressed, .let_go = let_go_};
  if (share) done.swing_taken = swing_taken_;
  const Hint step = next_step(tip, done);
  const bool at_once = !shown_ || tip.material != material_ || concerns_safety(step) || concerns_safety(*shown_) ||
                       needs_force(step) != needs_force(*shown_);
  material_ = tip.material;
  if (shown_ && !at_once && now_ns - shown_since_ns_ < kReadableNs) return *shown_;
  const Hint reward = share ? Hint::SwingsFree : Hint::LetGo;
  const Hint next = reward_due_ && needs_force(step) ? reward : step;
  if (next == reward) reward_due_ = false;
  if (begins_again(next)) let_go_ = false;
  if (shown_ != next) {
    shown_ = next;
    shown_since_ns_ = now_ns;
  }
  return *shown_;
}

}  // namespace afm::exhibit
