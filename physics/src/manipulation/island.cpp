// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/island.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace afm::physics {
namespace {

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

// Travel over rho from one angle to another while tip and rim stick, and while they slip.
double sticking_travel(double from_rad, double to_rad) {
  return std::log(std::tan(0.5 * to_rad) / std::tan(0.5 * from_rad)) / kIslandTurning;
}
double slipping_travel(double from_rad, double to_rad, double tip_friction) {
  const double delta = std::atan(tip_friction);
  return std::cos(delta) * std::log(std::tan(0.5 * (to_rad - delta)) / std::tan(0.5 * (from_rad - delta)));
}

}  // namespace

double island_way(double way_m, double turned_rad, double radius_m) noexcept {
  return std::sqrt(way_m * way_m + turned_rad * turned_rad * radius_m * radius_m / kIslandArm2);
}

double island_turning_share(double tip_friction) noexcept {
  const double squares = tip_friction * tip_friction;
  return std::sqrt((1.0 + squares) / (1.0 + (1.0 + kIslandArm2) * squares));
}

double largest_sticking_angle(double tip_friction) noexcept { return std::atan(tip_friction * (1.0 + kIslandArm2)); }

double island_travel_until_lost(double offset_over_rho, double tip_friction) noexcept {
  const double from_rad = std::asin(std::min(1.0, std::abs(offset_over_rho)));
  const double slips_rad = largest_sticking_angle(tip_friction);
  if (from_rad >= slips_rad) return slipping_travel(from_rad, kQuarterTurn, tip_friction);
  return sticking_travel(from_rad, slips_rad) + slipping_travel(slips_rad, kQuarterTurn, tip_friction);
}

}  // namespace afm::physics
