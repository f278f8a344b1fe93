// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace afm::physics {

// Particles by cells of a square grid, so that a tick looks only at those near a point. Particles beyond the grid count
// to its outermost cells. The constructor allocates, nothing else does.
class ParticleGrid {
 public:
  // `cell_m`: no search may have a larger radius.
  ParticleGrid(const std::vector<double>& x_m, const std::vector<double>& y_m, double cell_m);

  void move(std::size_t particle, double x_m, double y_m) noexcept;

  // Calls visit(particle) for every particle within cell_m of the point, and for some beyond.
  template <class Visit>
  void near(double x_m, double y_m, const Visit& visit) const noexcept {
    const std::size_t column = cell_of(x_m, left_m_, columns_), row = cell_of(y_m, bottom_m_, rows_);
    for (std::size_t r = row > 0 ? row - 1 : 0; r <= row + 1 && r < rows_; ++r) {
      for (std::size_t c = column > 0 ? column - 1 : 0; c <= column + 1 && c < columns_; ++c) {
        for (std::int32_t at = first_[r * columns_ + c]; at >= 0; at = next_[static_cast<std::size_t>(at)]) {
          visit(static_cast<std::size_t>(at));
        }
      }
    }
  }

 private:
  std::size_t cell_of(double value_m, double origin_m, std::size_t cells) const noexcept;
  void link(std::size_t particle, std::size_t cell) noexcept;

  double cell_m_, left_m_ = 0.0, bottom_m_ = 0.0;
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::int32_t> first_, next_, previous_;
  std::vector<std::size_t> cell_;
};

}  // namespace afm::physics
