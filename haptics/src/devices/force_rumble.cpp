// SPDX-License-Identifier: Apache-2.0
#include "devices/force_rumble.h"

#include <algorithm>

namespace afm::haptics {

Rumble ForceRumble::step(double force_n, std::int64_t now_ns) noexcept {
  const double change_n = force_n - before_n_[oldest_];
  before_n_[oldest_] = force_n;
  oldest_ = (oldest_ + 1) % kWindow;
  if (change_n > kJumpN) shakes_until_ns_ = std::max(shakes_until_ns_, now_ns + kSnapNs);
  if (change_n < -kJumpN) shakes_until_ns_ = now_ns + kReleaseNs;
  return {.heavy = now_ns < shakes_until_ns_ ? 1.0 : 0.0,
          .light = force_n < kFaintN ? 0.0 : kHumShare * std::min(1.0, force_n / cap_n_)};
}

}  // namespace afm::haptics
