// SPDX-License-Identifier: Apache-2.0
#include "physics/measured_branches.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace afm::physics {

namespace {

// On average at least: single samples that happen to lie close together would make a jump out of noise.
constexpr std::size_t kSamplesABin = 4;

struct Window {
  Length bottom;
  Length top;
};

std::vector<MeasuredPoint> binned(std::span<const CurvePoint> points, Branch branch, const Window& window,
                                  std::size_t most_points) {
  std::vector<CurvePoint> rising;
  for (const CurvePoint& point : points) {
    if (point.branch == branch && point.z >= window.bottom && point.z <= window.top) rising.push_back(point);
  }
  std::stable_sort(rising.begin(), rising.end(), [](const auto& a, const auto& b) { return a.z < b.z; });

  const std::size_t bins = std::clamp<std::size_t>(rising.size() / kSamplesABin, 1, most_points);
  const auto bin_of = [&](const CurvePoint& point) {
    const double place = (point.z - window.bottom) / (window.top - window.bottom);
    return std::min(bins - 1, static_cast<std::size_t>(place * static_cast<double>(bins)));
  };
  std::vector<MeasuredPoint> result;
  for (std::size_t first = 0, last = 0; first < rising.size(); first = last) {
    std::vector<double> forces;
    Length z_sum;
    for (; last < rising.size() && bin_of(rising[last]) == bin_of(rising[first]); ++last) {
      forces.push_back(rising[last].force.si);
      z_sum = z_sum + rising[last].z;
    }
    const auto middle = forces.begin() + static_cast<std::ptrdiff_t>(forces.size() / 2);
    std::nth_element(forces.begin(), middle, forces.end());
    result.push_back({z_sum / static_cast<double>(forces.size()), Force(*middle)});
  }
  return result;
}

}  // namespace

MeasuredBranches measured_branches(std::span<const CurvePoint> points, std::size_t most_points) {
  const CurveFeatures features = analyse(points);
  if (!features.contact_point) {
    throw std::invalid_argument("the curve has no contact point: its approach never pushes the tip away");
  }
  std::vector<CurvePoint> centred(points.begin(), points.end());
  Window window{Length(HUGE_VAL), Length(-HUGE_VAL)};
  for (CurvePoint& point : centred) {
    point.force = point.force - features.baseline.at(point.z);
    point.z = point.z - *features.contact_point;
    window.bottom = std::min(window.bottom, point.z);
    window.top = std::max(window.top, point.z);
  }
  Length farthest;
  if (features.snap_in) farthest = std::max(farthest, features.snap_in->z - *features.contact_point);
  if (features.pull_off) farthest = std::max(farthest, features.pull_off->z - *features.contact_point);
  if (farthest.si > 0.0) window.top = std::min(window.top, 1.5 * farthest);

  MeasuredBranches branches{binned(centred, Branch::Approach, window, most_points),
                            binned(centred, Branch::Retract, window, most_points)};
  if (branches.retract.empty()) throw std::invalid_argument("the curve has no retract branch, without which no loop");
  return branches;
}

}  // namespace afm::physics
