// SPDX-License-Identifier: Apache-2.0
#include "haptics/height_potential.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace afm::haptics {

HeightPotential::HeightPotential(const PotentialEnergy::ForceOverHeight& force_n, PotentialEnergy::Range range)
    : lowest_m_(range.lowest_m) {
  AFM_CHECK(range.highest_m > range.lowest_m && std::isfinite(range.highest_m - range.lowest_m));
  const auto count = static_cast<std::size_t>(std::ceil((range.highest_m - range.lowest_m) / kSpacingM)) + 1;
  nodes_.resize(count);
  const auto height_m = [&](std::size_t i) { return lowest_m_ + kSpacingM * static_cast<double>(i); };
  nodes_.back().force_n = force_n(height_m(count - 1));
  for (std::size_t i = count - 1; i-- > 0;) {
    nodes_[i].force_n = force_n(height_m(i));
    // Simpson's rule
    const double mean_n =
        (nodes_[i].force_n + 4.0 * force_n(height_m(i) + 0.5 * kSpacingM) + nodes_[i + 1].force_n) / 6.0;
    nodes_[i].energy_j = nodes_[i + 1].energy_j + kSpacingM * mean_n;
  }
}

HeightPotential::Value HeightPotential::at(double height_m) const noexcept {
  const double place = (height_m - lowest_m_) / kSpacingM;
  const auto last = static_cast<double>(nodes_.size() - 1);
  // written so that NaN goes to an end, too
  if (!(place > 0.0)) {
    const Node& end = nodes_.front();
    return {end.energy_j - end.force_n * kSpacingM * std::fmin(place, 0.0), end.force_n};
  }
  if (place >= last) {
    const Node& end = nodes_.back();
    return {end.energy_j - end.force_n * kSpacingM * (place - last), end.force_n};
  }
  const double node = std::fmin(std::floor(place), last - 1.0), t = place - node;
  const auto i = static_cast<std::size_t>(node);
  const Node &below = nodes_[i], &above = nodes_[i + 1];
  const double rise_j = above.energy_j - below.energy_j, step = t * t * (3.0 - 2.0 * t);
  const double along_below = t * (1.0 - t) * (1.0 - t), along_above = -t * t * (1.0 - t);
  return {below.energy_j + step * rise_j - kSpacingM * (along_below * below.force_n + along_above * above.force_n),
          -6.0 * t * (1.0 - t) * rise_j / kSpacingM + (1.0 - t) * (1.0 - 3.0 * t) * below.force_n +
              t * (3.0 * t - 2.0) * above.force_n};
}

}  // namespace afm::haptics
