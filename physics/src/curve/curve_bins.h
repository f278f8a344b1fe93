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
  Length z;  // mean height
  Force mean;
  Force median;  // median; upper one for an even number; keeps a jump as sharp as the bins, rejects single outliers
  Force middle;  // mean of the middle half: rejects single outliers, and preserves the area under the branch
};

// Mean of the middle half of values in rising order.
inline Force middle_half(std::span<const double> values) {
  const std::size_t left_out = values.size() / 4;
  double sum = 0.0;
  for (std::size_t i = left_out; i < values.size() - left_out; ++i) sum += values[i];
  return Force(sum / static_cast<double>(values.size() - 2 * left_out));
}

// Sorts points by rising Z, for example from a noisy sensor.
inline void put_in_order(std::vector<CurvePoint>& points) {
  const auto is_lower = [](const CurvePoint& a, const CurvePoint& b) { return a.z < b.z; };
  // most approaches are recorded from above
  const auto kept =
      std::adjacent_find(points.begin(), points.end(), [](const auto& a, const auto& b) { return !(b.z < a.z); });
  if (kept == points.end()) {
    std::reverse(points.begin(), points.end());
  } else if (!std::is_sorted(points.begin(), points.end(), is_lower)) {
    std::stable_sort(points.begin(), points.end(), is_lower);
  }
}

// Calls back with the points of each bin, in the order of rising Z, of those between `bottom` and `top`, of either
// branch: bins of equal width, at most `most_bins`, and few enough for `fewest_samples` in each on average; none is
// empty.
template <class OnBin>
void for_each_bin(std::span<const CurvePoint> points, Length bottom, Length top, std::size_t most_bins,
                  std::size_t fewest_samples, const OnBin& on_bin) {
  std::vector<CurvePoint> rising;
  rising.reserve(points.size());
  for (const CurvePoint& point : points) {
    if (point.z >= bottom && point.z <= top) rising.push_back(point);
  }
  put_in_order(rising);
  const std::size_t bins = std::clamp<std::size_t>(rising.size() / fewest_samples, 1, most_bins);
  const auto bin_of = [&](const CurvePoint& point) {
    const double place =
        top > bottom ? (point.z - bottom) / (top - bottom) : 0.0;  // flat if all points have one height
    return std::min(bins - 1, static_cast<std::size_t>(place * static_cast<double>(bins)));
  };
  for (std::size_t first = 0, last = 0; first < rising.size(); first = last) {
    const std::size_t bin = bin_of(rising[first]);
    while (last < rising.size() && bin_of(rising[last]) == bin) ++last;
    on_bin(std::span(rising).subspan(first, last - first));
  }
}

// Mean of a bin.
struct MeanBin {
  Length z;
  Force mean;
};

inline MeanBin mean_of(std::span<const CurvePoint> points) {
  MeanBin sum;
  for (const CurvePoint& point : points) {
    sum.z = sum.z + point.z;
    sum.mean = sum.mean + point.force;
  }
  const auto count = static_cast<double>(points.size());
  return {sum.z / count, sum.mean / count};
}

// Means of the bins of for_each_bin() with at least one sample.
inline std::vector<MeanBin> mean_bins(std::span<const CurvePoint> points, Length bottom, Length top,
                                      std::size_t most_bins) {
  std::vector<MeanBin> result;
  result.reserve(std::min(points.size(), most_bins));
  for_each_bin(points, bottom, top, most_bins, 1,
               [&](std::span<const CurvePoint> bin) { result.push_back(mean_of(bin)); });
  return result;
}

// Bins of for_each_bin() with their medians.
inline std::vector<CurveBin> curve_bins(std::span<const CurvePoint> points, Length bottom, Length top,
                                        std::size_t most_bins, std::size_t fewest_samples) {
  std::vector<CurveBin> result;
  std::vector<double> forces;
  for_each_bin(points, bottom, top, most_bins, fewest_samples, [&](std::span<const CurvePoint> bin) {
    forces.clear();
    for (const CurvePoint& point : bin) forces.push_back(point.force.si);
    std::sort(forces.begin(), forces.end());
    const MeanBin mean = mean_of(bin);
    result.push_back({mean.z, mean.mean, Force(forces[forces.size() / 2]), middle_half(forces)});
  });
  return result;
}

}  // namespace afm::physics
