// SPDX-License-Identifier: Apache-2.0
#include "curves/force_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace afm::curves {

namespace {

constexpr double kForceUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kOutlyingPixels = 0.1;  // share of the pixels whose forces may be beyond the range
constexpr double kLeastOther = 0.02;     // smaller end of the range as a share of the larger one, at least
constexpr double kForceless = 0.05;      // share of the range below which there is hardly a force
constexpr double kAbove = 1.2;           // shown height, as a multiple of the height with a force

// Value at a share of the sorted ones; 0 without any.
double at_share(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::size_t index_at(double place, std::size_t count) {
  // NaN goes to the first
  const double within =
      std::fmin(std::fmax(0.0, std::floor(place * static_cast<double>(count))), static_cast<double>(count) - 1.0);
  return static_cast<std::size_t>(within);
}

}  // namespace

void ForceVolume::Gatherer::add(const RecordedCurve& curve) {
  if (!curve.metadata.pixel) return;
  const MapPixel& pixel = *curve.metadata.pixel;
  const std::size_t stride = stride_of(pixel.grid);
  if (pixel.column % stride != 0 || pixel.row % stride != 0) return;
  physics::MeasuredBranches branches;
  try {
    branches = physics::measured_branches(curve.points, kMostPoints);
  } catch (const std::invalid_argument&) {
    return;
  }
  if (branches.approach.empty() || branches.retract.empty()) return;
  const std::lock_guard lock(mutex_);
  if (!grid_) grid_ = pixel.grid;
  if (*grid_ == pixel.grid) found_.emplace_back(pixel, std::move(branches));
}

ForceVolume ForceVolume::Gatherer::finish() {
  ForceVolume volume;
  if (!grid_) return volume;
  volume.grid_ = *grid_;
  volume.stride_ = stride_of(*grid_);
  volume.columns_ = (grid_->columns - 1) / volume.stride_ + 1;
  volume.rows_ = (grid_->rows - 1) / volume.stride_ + 1;
  volume.cells_.resize(volume.columns_ * volume.rows_);
  for (const auto& [pixel, branches] : found_) {
    Cell& cell = volume.cells_[(pixel.row / volume.stride_) * volume.columns_ + pixel.column / volume.stride_];
    const physics::Length deepest = std::min(branches.approach.front().z, branches.retract.front().z);
    const auto take = [&](const std::vector<physics::MeasuredPoint>& points, Branch& branch) {
      branch.clear();
      branch.reserve(points.size());
      for (const physics::MeasuredPoint& point : points) {
        branch.push_back({static_cast<float>((point.z - deepest).si), static_cast<float>(point.force.si)});
      }
    };
    take(branches.approach, cell[0]);
    take(branches.retract, cell[1]);
  }
  found_.clear();
  volume.measure();
  return volume;
}

std::size_t ForceVolume::stride_of(const MapGrid& grid) {
  return (std::max(grid.columns, grid.rows) + kMostSide - 1) / kMostSide;
}

void ForceVolume::measure() {
  std::vector<double> pulls, pushes, tops;
  for (const Cell& cell : cells_) {
    if (cell[0].empty()) continue;
    double pull_n = 0.0, push_n = 0.0;
    for (const Branch& branch : cell) {
      for (const Point& point : branch) {
        pull_n = std::min(pull_n, static_cast<double>(point.force_n));
        push_n = std::max(push_n, static_cast<double>(point.force_n));
      }
    }
    pulls.push_back(pull_n);
    pushes.push_back(push_n);
  }
  const double pull_n = at_share(pulls, kOutlyingPixels), push_n = at_share(pushes, 1.0 - kOutlyingPixels);
  strongest_pull_n_ = std::min(pull_n, -kLeastOther * push_n);
  strongest_push_n_ = std::max(push_n, -kLeastOther * pull_n);
  for (const Cell& cell : cells_) {
    double top_m = 0.0;
    for (const Branch& branch : cell) {
      for (const Point& point : branch) {
        const double force_n = static_cast<double>(point.force_n);
        const double share = force_n < 0.0 ? force_n / strongest_pull_n_ : force_n / strongest_push_n_;
        if (share > kForceless) top_m = std::max(top_m, static_cast<double>(point.height_m));
      }
    }
    if (top_m > 0.0) tops.push_back(kAbove * top_m);
  }
  top_m_ = at_share(tops, 1.0 - kOutlyingPixels);
}

std::size_t ForceVolume::known() const {
  return static_cast<std::size_t>(
      std::count_if(cells_.begin(), cells_.end(), [](const Cell& cell) { return !cell[0].empty(); }));
}

const ForceVolume::Branch& ForceVolume::branch_at(Way way, double across, double up) const {
  static const Branch kNothing;
  if (cells_.empty()) return kNothing;
  const std::size_t column = index_at(across, grid_.columns) / stride_, row = index_at(up, grid_.rows) / stride_;
  return cells_[row * columns_ + column][way == Way::Approach ? 0 : 1];
}

double ForceVolume::force_n(Way way, double across, double up, double height_m) const {
  const Branch& branch = branch_at(way, across, up);
  const auto above = std::lower_bound(branch.begin(), branch.end(), height_m, [](const Point& point, double height) {
    return static_cast<double>(point.height_m) < height;
  });
  if (above == branch.end()) return kForceUnknown;
  // the approach may turn a little above the deepest point
  if (above == branch.begin()) return static_cast<double>(above->force_n);
  const Point& below = *(above - 1);
  const double from_m = static_cast<double>(below.height_m), from_n = static_cast<double>(below.force_n);
  const double way_m = static_cast<double>(above->height_m) - from_m;
  const double share = way_m > 0.0 ? (height_m - from_m) / way_m : 1.0;
  return from_n + share * (static_cast<double>(above->force_n) - from_n);
}

double ForceVolume::height_of_m(double force_n, double across, double up) const {
  return height_on(branch_at(force_n < 0.0 ? Way::Retract : Way::Approach, across, up), force_n);
}

std::size_t ForceVolume::reached(double force_n) const {
  return static_cast<std::size_t>(std::count_if(cells_.begin(), cells_.end(), [force_n](const Cell& cell) {
    return std::isfinite(height_on(cell[force_n < 0.0 ? 1 : 0], force_n));
  }));
}

// Greatest height at which a branch reaches a force. Searches from above.
double ForceVolume::height_on(const Branch& branch, double force_n) {
  const auto reaches = [&](const Point& point) {
    const double at_n = static_cast<double>(point.force_n);
    return force_n < 0.0 ? at_n <= force_n : at_n >= force_n;
  };
  const auto found = std::find_if(branch.rbegin(), branch.rend(), reaches);
  if (found == branch.rend()) return kForceUnknown;
  const double height_m = static_cast<double>(found->height_m), there_n = static_cast<double>(found->force_n);
  if (found == branch.rbegin()) return height_m;
  const Point& before = *(found - 1);
  const double change_n = static_cast<double>(before.force_n) - there_n;
  const double share = change_n != 0.0 ? (force_n - there_n) / change_n : 0.0;
  return height_m + share * (static_cast<double>(before.height_m) - height_m);
}

}  // namespace afm::curves
