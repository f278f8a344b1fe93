// SPDX-License-Identifier: Apache-2.0
#include "particle_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace afm::physics {
namespace {

constexpr double kMostCells = 256.0;  // largest number of cells per side

}  // namespace

ParticleGrid::ParticleGrid(const std::vector<double>& x_m, const std::vector<double>& y_m, double cell_m)
    : cell_m_(cell_m), next_(x_m.size(), -1), previous_(x_m.size(), -1), cell_(x_m.size(), 0) {
  if (!x_m.empty()) {
    const auto [left, right] = std::minmax_element(x_m.begin(), x_m.end());
    const auto [bottom, top] = std::minmax_element(y_m.begin(), y_m.end());
    // larger cells for a wide set; one more cell on each side for particles that are pushed away
    cell_m_ = std::max(cell_m, std::max(*right - *left, *top - *bottom) / (kMostCells - 3.0));
    left_m_ = *left - cell_m_;
    bottom_m_ = *bottom - cell_m_;
    columns_ = static_cast<std::size_t>((*right - left_m_) / cell_m_) + 2;
    rows_ = static_cast<std::size_t>((*top - bottom_m_) / cell_m_) + 2;
  }
  first_.assign(columns_ * rows_, -1);
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    link(i, cell_of(y_m[i], bottom_m_, rows_) * columns_ + cell_of(x_m[i], left_m_, columns_));
  }
}

void ParticleGrid::move(std::size_t particle, double x_m, double y_m) noexcept {
  const std::size_t cell = cell_of(y_m, bottom_m_, rows_) * columns_ + cell_of(x_m, left_m_, columns_);
  if (cell == cell_[particle]) return;
  const std::int32_t before = previous_[particle], after = next_[particle];
  (before >= 0 ? next_[static_cast<std::size_t>(before)] : first_[cell_[particle]]) = after;
  if (after >= 0) previous_[static_cast<std::size_t>(after)] = before;
  link(particle, cell);
}

std::size_t ParticleGrid::cell_of(double value_m, double origin_m, std::size_t cells) const noexcept {
  const double place = std::clamp((value_m - origin_m) / cell_m_, 0.0, static_cast<double>(cells) - 1.0);
  return static_cast<std::size_t>(place);
}

void ParticleGrid::link(std::size_t particle, std::size_t cell) noexcept {
  // by falling number, so that a search does not depend on the way that the particles came
  const auto number = static_cast<std::int32_t>(particle);
  std::int32_t before = -1, after = first_[cell];
  while (after > number) before = std::exchange(after, next_[static_cast<std::size_t>(after)]);
  cell_[particle] = cell;
  previous_[particle] = before;
  next_[particle] = after;
  (before >= 0 ? next_[static_cast<std::size_t>(before)] : first_[cell]) = number;
  if (after >= 0) previous_[static_cast<std::size_t>(after)] = number;
}

}  // namespace afm::physics
