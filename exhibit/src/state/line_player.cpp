// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/line_player.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace afm::exhibit {

void LinePlayer::begin(physics::ScanLine line) {
  line_ = std::move(line);
  const bool whole = !line_.trace.height_m.empty() && line_.retrace.height_m.size() == line_.trace.height_m.size();
  seconds_ = whole ? 0.0 : kSeconds;
}

void LinePlayer::advance(double seconds) { seconds_ = std::min(kSeconds, seconds_ + seconds); }

LinePlayer::Place LinePlayer::place() const {
  const double share = 2.0 * seconds_ / kSeconds;  // 1 at the right edge
  const bool returning = share > 1.0;
  const double along = returning ? 2.0 - share : share;
  const physics::ScanTrack& track = returning ? line_.retrace : line_.trace;
  const std::size_t last = track.height_m.size() - 1;
  const double column = std::clamp(along * static_cast<double>(last + 1) - 0.5, 0.0, static_cast<double>(last));
  const auto left = static_cast<std::size_t>(column);
  const std::size_t right = std::min(left + 1, last);
  const auto between = [&](const std::vector<double>& values) {
    return std::lerp(values[left], values[right], column - static_cast<double>(left));
  };
  const bool force = track.phase_deg.empty() && track.error_n.size() == track.height_m.size();
  return {.along = along,
          .height_m = between(track.height_m),
          .error_n = force ? between(track.error_n) : 0.0,
          .returning = returning};
}

}  // namespace afm::exhibit
