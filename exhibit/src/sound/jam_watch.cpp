// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/jam_watch.h"

#include <cmath>
#include <utility>

namespace afm::exhibit {

std::optional<double> JamWatch::add(const scene::TipPush& push) {
  const bool still = std::exchange(digest_, push.digest) == push.digest;
  const double lateral_n = std::hypot(push.lateral_n[0], push.lateral_n[1]);
  const bool presses = push.met != 0 && push.particle != scene::kNoParticle && push.normal_n > 0.0 &&
                       push.threshold_n > 0.0 && lateral_n >= kTimes * push.threshold_n;
  if (!presses) jammed_ = false;
  if (!presses || !still || std::exchange(jammed_, true)) return std::nullopt;
  return lateral_n;
}

}  // namespace afm::exhibit
