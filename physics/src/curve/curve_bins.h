// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/curve_point.h"

namespace afm::physics {

// Neighbours along Z, combined to one point.
struct CurveBin {
  Length z;  // mean
  Force mean;
  Force median;  // upper one for an even number; keeps a jump as sharp as the bins and rejects single outliers
  Force middle;  // mean of the middle half: rejects single outliers, and preserves the area under the branch
};

// Requires rising values.
inline Force middle_half(std::span<const double> values) {
  const std::size_t left_out = values.size() / 4;
  double sum = 0.0;
  for (std::size_t i = left_out; i < values.size() - left_out; ++i) sum += values[i];
  return Force(sum / static_cast<double>(values.size() - 2 * left_out));
}

// The points between `bottom` and `top`, of either branch, in bins of equal width along rising Z, without empty ones.
// At most `most_bins`, and few enough for `fewest_samples` in each on average. Heights out of order, as from a sensor,
// are put into the right bin.
inline std::vector<CurveBin> curve_bins(std::span<const CurvePoint> points, Length bottom, Length top,
                                        std::size_t most_bins, std::size_t fewest_samples) {
  std::vector<CurvePoint> rising;
  for (const CurvePoint& point : points) {
    if (point.z >= bottom && point.z <= top) rising.push_back(point);
  }
  std::stable_sort(rising.begin(), rising.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  const std::size_t bins = std::clamp<std::size_t>(rising.size() / fewest_samples, 1, most_bins);
  const auto bin_of = [&](const CurvePoint& point) {
    const double place =
        top > bottom ? (point.z - bottom) / (top - bottom) : 0.0;  // flat if all points have one height
    return std::min(bins - 1, static_cast<std::size_t>(place * static_cast<double>(bins)));
  };
  std::vector<CurveBin> result;
  std::vector<double> forces;
  for (std::size_t first = 0, last = 0; first < rising.size(); first = last) {
    forces.clear();
    CurveBin bin;
    for (; last < rising.size() && bin_of(rising[last]) == bin_of(rising[first]); ++last) {
      forces.push_back(rising[last].force.si);
      bin.z = bin.z + rising[last].z;
      bin.mean = bin.mean + rising[last].force;
    }
    const auto count = static_cast<double>(forces.size());
    std::sort(forces.begin(), forces.end());
    result.push_back({bin.z / count, bin.mean / count, Force(forces[forces.size() / 2]), middle_half(forces)});
  }
  return result;
}

}  // namespace afm::physics
