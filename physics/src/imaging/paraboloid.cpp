// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "physics/morphology.h"

namespace afm::physics {
namespace {

// The highest place of parabolas -d^2/2R below each point of a line, at each point. Some of them are on the upper
// envelope, each between two places; those that are not are dropped.
class ParabolaEnvelope {
 public:
  ParabolaEnvelope(std::size_t count, double step_m, double radius_m)
      : step_m_(std::abs(step_m)), two_radii_m_(2.0 * radius_m), heights_m_(count), hung_(count), from_(count + 1) {}

  // `line`: heights, `stride` apart; replaced.
  void dilate(double* line, std::size_t stride) {
    const std::size_t count = heights_m_.size();
    for (std::size_t i = 0; i < count; ++i) heights_m_[i] = line[i * stride];
    find_envelope();
    std::size_t k = 0;
    for (std::size_t i = 0; i < count; ++i) {
      while (k + 1 < kept_ && from_[k + 1] < static_cast<double>(i)) ++k;
      // where two of them cross at a point, rounding decides which one was found: its neighbours are looked at as well
      double highest_m = heights_m_[i];
      for (std::size_t j = k < 2 ? 0 : k - 2; j < std::min(k + 3, kept_); ++j) {
        highest_m = std::max(highest_m, hanging_m(hung_[j], i));
      }
      line[i * stride] = highest_m;
    }
  }

 private:
  double hanging_m(std::size_t from, std::size_t at) const {
    const double distance_m = (static_cast<double>(at) - static_cast<double>(from)) * step_m_;
    return heights_m_[from] - distance_m * distance_m / two_radii_m_;
  }

  // Where the parabola of `right` rises above that of `left`, in points.
  double crossing(std::size_t left, std::size_t right) const {
    const auto a = static_cast<double>(left), b = static_cast<double>(right);
    return 0.5 * (a + b) - (heights_m_[right] - heights_m_[left]) * two_radii_m_ / (2.0 * step_m_ * step_m_ * (b - a));
  }

  void find_envelope() {
    constexpr double kRounding = 1e-6;  // of a crossing, in points: one that only touches the envelope is kept
    kept_ = 0;
    for (std::size_t i = 0; i < heights_m_.size(); ++i) {
      while (kept_ > 1 && crossing(hung_[kept_ - 1], i) < from_[kept_ - 1] - kRounding) --kept_;
      from_[kept_] = kept_ == 0 ? -std::numeric_limits<double>::infinity() : crossing(hung_[kept_ - 1], i);
      hung_[kept_++] = i;
    }
  }

  double step_m_, two_radii_m_;
  std::vector<double> heights_m_;
  std::vector<std::size_t> hung_;  // points whose parabolas are on the envelope, and from where on
  std::vector<double> from_;
  std::size_t kept_ = 0;
};

}  // namespace

void dilate_by_paraboloid(HeightGrid& surface, Length radius) {
  ParabolaEnvelope along_rows(surface.columns, surface.column_step_m, radius.si);
  for (std::size_t row = 0; row < surface.rows; ++row) along_rows.dilate(&surface.at(0, row), 1);
  ParabolaEnvelope along_columns(surface.rows, surface.row_step_m, radius.si);
  for (std::size_t column = 0; column < surface.columns; ++column) {
    along_columns.dilate(&surface.at(column, 0), surface.columns);
  }
}

void erode_by_paraboloid(HeightGrid& image, Length radius) {
  for (double& height_m : image.height_m) height_m = -height_m;
  dilate_by_paraboloid(image, radius);
  for (double& height_m : image.height_m) height_m = -height_m;
}

}  // namespace afm::physics
