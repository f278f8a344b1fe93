// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "physics/imaging/morphology.h"

namespace afm::physics {
namespace {

// Upper envelope of the parabolas -d^2/2R below each point of a line. Each parabola on the envelope has one interval;
// all others are dropped.
class ParabolaEnvelope {
 public:
  ParabolaEnvelope(std::size_t count, double step_m, double radius_m)
      : step_m_(std::abs(step_m)), two_radii_m_(2.0 * radius_m), heights_m_(count), hung_(count), from_(count + 1) {}

  // Replaces the heights by the dilated ones.
  void dilate(std::span<double> line) {
    std::copy(line.begin(), line.end(), heights_m_.begin());
    find_envelope();
    std::size_t k = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto place = static_cast<double>(i);
      while (k + 1 < kept_ && from_[k + 1] < place) ++k;
      double highest_m = std::max(heights_m_[i], hanging_m(hung_[k], i));
      // where parabolas cross at a point, rounding decides which one was found
      for (std::size_t j = k; j > 0 && from_[j] > place - kRounding; --j) {
        highest_m = std::max(highest_m, hanging_m(hung_[j - 1], i));
      }
      for (std::size_t j = k + 1; j < kept_ && from_[j] < place + kRounding; ++j) {
        highest_m = std::max(highest_m, hanging_m(hung_[j], i));
      }
      line[i] = highest_m;
    }
  }

 private:
  static constexpr double kRounding = 1e-6;  // tolerance of a crossing, in points

  double hanging_m(std::size_t from, std::size_t at) const {
    const double distance_m = (static_cast<double>(at) - static_cast<double>(from)) * step_m_;
    return heights_m_[from] - distance_m * distance_m / two_radii_m_;
  }

  // Place from which the parabola of `right` is above that of `left`, in points.
  double crossing(std::size_t left, std::size_t right) const {
    const auto a = static_cast<double>(left), b = static_cast<double>(right);
    return 0.5 * (a + b) - (heights_m_[right] - heights_m_[left]) * two_radii_m_ / (2.0 * step_m_ * step_m_ * (b - a));
  }

  void find_envelope() {
    // a parabola that only touches the envelope is kept
    kept_ = 0;
    for (std::size_t i = 0; i < heights_m_.size(); ++i) {
      while (kept_ > 1 && crossing(hung_[kept_ - 1], i) < from_[kept_ - 1] - kRounding) --kept_;
      from_[kept_] = kept_ == 0 ? -std::numeric_limits<double>::infinity() : crossing(hung_[kept_ - 1], i);
      hung_[kept_++] = i;
    }
  }

  double step_m_, two_radii_m_;
  std::vector<double> heights_m_;
  std::vector<std::size_t> hung_;  // points whose parabolas are on the envelope, with the beginning of their intervals
  std::vector<double> from_;
  std::size_t kept_ = 0;
};

// `to[column][row] = from[row][column]`, in squares that fit into the processor's cache.
void transpose(const std::vector<double>& from, std::size_t columns, std::size_t rows, std::vector<double>& to) {
  constexpr std::size_t kSquare = 32;
  to.resize(from.size());
  for (std::size_t top = 0; top < rows; top += kSquare) {
    for (std::size_t left = 0; left < columns; left += kSquare) {
      for (std::size_t row = top; row < std::min(top + kSquare, rows); ++row) {
        for (std::size_t column = left; column < std::min(left + kSquare, columns); ++column) {
          to[column * rows + row] = from[row * columns + column];
        }
      }
    }
  }
}

void dilate_lines(std::vector<double>& heights_m, std::size_t length, double step_m, Length radius) {
  ParabolaEnvelope envelope(length, step_m, radius.si);
  for (std::size_t start = 0; start < heights_m.size(); start += length) {
    envelope.dilate(std::span(heights_m).subspan(start, length));
  }
}

}  // namespace

void dilate_by_paraboloid(HeightGrid& surface, Length radius) {
  std::vector<double> by_columns;
  dilate_lines(surface.height_m, surface.columns, surface.column_step_m, radius);
  transpose(surface.height_m, surface.columns, surface.rows, by_columns);
  dilate_lines(by_columns, surface.rows, surface.row_step_m, radius);
  transpose(by_columns, surface.rows, surface.columns, surface.height_m);
}

void erode_by_paraboloid(HeightGrid& image, Length radius) {
  for (double& height_m : image.height_m) height_m = -height_m;
  dilate_by_paraboloid(image, radius);
  for (double& height_m : image.height_m) height_m = -height_m;
}

}  // namespace afm::physics
