// SPDX-License-Identifier: Apache-2.0
#include "physics/lennard_jones.h"

#include <numbers>

namespace afm::physics {
namespace {

constexpr double kEightPiThirds = 8.0 * std::numbers::pi / 3.0;

}  // namespace

Energy LennardJones::potential(Length gap) const noexcept {
  const double x = z0_ / gap;
  const double x2 = x * x;
  return -kEightPiThirds * force_scale_ * z0_ * (x * (1.0 - x2 * x2 * x2 / 28.0));
}

Force LennardJones::force(Length gap) const noexcept {
  const double x = z0_ / gap;
  const double x2 = x * x;
  return -kEightPiThirds * force_scale_ * (x2 * (1.0 - x2 * x2 * x2 / 4.0));
}

Stiffness LennardJones::gradient(Length gap) const noexcept {
  const double x = z0_ / gap;
  const double x2 = x * x;
  return kEightPiThirds * force_scale_ / z0_ * (2.0 * x * x2 * (1.0 - x2 * x2 * x2));
}

}  // namespace afm::physics
