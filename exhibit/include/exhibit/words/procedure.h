// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "exhibit/words/guidance.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// The hint on the wall: the next step of the procedure, shown for long enough to be read. One thread.
class Procedure {
 public:
  static constexpr std::int64_t kReadableNs = 3'000'000'000;

  // Call once a frame. A hint is replaced early only if the force is switched on or off, or the sample changes. "It let
  // go" is shown after every cycle, even if the next one follows at once.
  Hint update(const scene::TipState& tip, const CycleProgress& progress, std::int64_t now_ns);

 private:
  void follow_cycles(const scene::TipState& tip, int cycles);
  void follow_swing(const scene::TipState& tip, std::optional<double> share);

  std::optional<Hint> shown_;
  std::int64_t shown_since_ns_ = 0;
  std::int32_t material_ = -1;
  int cycles_ = 0;
  bool swing_taken_ = false;  // true: the sample has taken the swing of a lever that taps, and not given it back
  bool let_go_ = false;       // true: pull-off since the force was switched on
  bool reward_due_ = false;   // true: pull-off not yet announced on the wall
};

}  // namespace afm::exhibit
