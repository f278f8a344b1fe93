// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "exhibit/words/guidance.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// The hint on the wall: the next step, each shown long enough to be read. One thread.
class Procedure {
 public:
  static constexpr std::int64_t kReadableNs = 3'000'000'000;

  // Once a frame. A hint gives way before its time only where the force goes, comes or is off, and with the sample.
  // "It let go" is shown after every cycle, however fast the next one follows.
  Hint update(const scene::TipState& tip, const CycleProgress& progress, std::int64_t now_ns);

 private:
  void follow_cycles(const scene::TipState& tip, int cycles);

  std::optional<Hint> shown_;
  std::int64_t shown_since_ns_ = 0;
  std::int32_t material_ = -1;
  int cycles_ = 0;
  bool let_go_ = false;      // since the force came on
  bool reward_due_ = false;  // it let go, which the wall has not said yet
};

}  // namespace afm::exhibit
