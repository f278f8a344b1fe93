// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "physics/friction/lattice_tip.h"

namespace afm::physics {

LatticeLandscape::LatticeLandscape(LatticeKind kind, Length period) noexcept : period_m_(period.si) {
  const double q = 2.0 * std::numbers::pi / period_m_;
  switch (kind) {
    case LatticeKind::Rows:
      waves_ = {{{q, 0.0}}};
      count_ = 1;
      break;
    case LatticeKind::Square:
      waves_ = {{{q, 0.0}, {0.0, q}}};
      count_ = 2;
      break;
    case LatticeKind::Hexagonal:
      const double across = q / std::numbers::sqrt3;
      waves_ = {{{q, across}, {q, -across}, {0.0, 2.0 * across}}};
      count_ = 3;
      break;
  }
}

LatticeLandscape::Place LatticeLandscape::at(double x_m, double y_m) const noexcept {
  Place place;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const auto [gx, gy] = waves_[i];
    const double phase = gx * x_m + gy * y_m;
    const double sine = std::sin(phase), cosine = std::cos(phase);
    place.height += 1.0 - cosine;
    place.slope_x += gx * sine;
    place.slope_y += gy * sine;
    place.bend_xx += gx * gx * cosine;
    place.bend_xy += gx * gy * cosine;
    place.bend_yy += gy * gy * cosine;
    place.third[0] -= gx * gx * gx * sine;
    place.third[1] -= gx * gx * gy * sine;
    place.third[2] -= gx * gy * gy * sine;
    place.third[3] -= gy * gy * gy * sine;
  }
  return place;
}

double LatticeLandscape::sharpest_bend() const noexcept {
  double sum = 0.0;
  for (const auto& [gx, gy] : waves_) sum += gx * gx + gy * gy;
  return sum;
}

double LatticeLandscape::highest() const noexcept { return 2.0 * count_; }

}  // namespace afm::physics
