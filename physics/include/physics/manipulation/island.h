// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/units.h"

// A flat island on a flat sample: a disc with the same friction everywhere below it, pushed at its rim by a tip that
// sticks there up to a coefficient of friction mu_t (docs/manipulation.md, "Flat islands"; equation numbers (M...)).
// alpha is the angle from the tip's path to the island. Any thread.
namespace afm::physics {

// R^2/c^2 of a disc, c = 2R/3 being moment over force of its friction (M40).
inline constexpr double kIslandArm2 = 9.0 / 4.0;

// kappa = 1/(1 + c^2/R^2) (M41): an island that turns about the tip is lost this much more slowly than a sphere.
inline constexpr double kIslandTurning = kIslandArm2 / (1.0 + kIslandArm2);

// Friction of an island that moves by `way` and turns, over the force that moves it without a turn: the ellipsoidal
// limit surface, sqrt(way^2 + c^2 turn^2) (M40).
double island_way(double way_m, double turned_rad, double radius_m) noexcept;

// Force on the lever over that which moves an island without a turn, where tip and rim only just stick: friction mu_t
// of the push along the normal (M40). The least such force.
double island_turning_share(double tip_friction) noexcept;

// The angle up to which tip and rim stick, tan(alpha) = mu_t (1 + R^2/c^2) (M42).
double largest_sticking_angle(double tip_friction) noexcept;

// Travel over rho, the distance of the axes of tip and island, until an island at the offset from the tip's path, over
// rho, is lost: alpha is a quarter turn (M43).
double island_travel_until_lost(double offset_over_rho, double tip_friction) noexcept;

}  // namespace afm::physics
