// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "lever_energy.h"
#include "lone_push.h"
#include "physics/manipulation/push_figures.h"

namespace afm::physics {

// Force of the tip on an island, along the normal of their contact, from the tip to the island, and across it.
struct RimForce {
  double along_n = 0.0;   // force along the normal; 0: no touch; negative: the tip rides over
  double across_n = 0.0;  // friction at the tip, across the normal
};

// Force that moves an island without a turn at the same distance from the limit surface (M40). The tip pushes at the
// rim, so that the force across also turns the island.
double load_of(const RimForce& force) noexcept;

// Force on the lever over load_of(): below 1 for an island that the tip turns.
double share_of_load(const RimForce& force) noexcept;

// One island and the tip at its rim.
struct IslandRim {
  PushSprings springs;
  double core_m = 0.0;    // radius of the flat part; the rim beyond it is round
  double radius_m = 0.0;  // R, radius of the island
  double tip_friction = 0.0;
};

// Friction that holds an island.
struct IslandFriction {
  double holds_n = 0.0;   // friction at the start, between f_k and f_s
  double moving_n = 0.0;  // friction during motion, f_k
  bool ages_at_once = false;
};

// An island without neighbours on a path of the base.
struct IslandPath {
  bool possible = false;  // false: the tip rides over or is above the island
  bool met = false;       // true: tip and island touched on the way
  Flat at;                // place of the island at the end
  double turned_rad = 0.0;
  Apex apex;            // resting place of the apex at the end
  double lost_j = 0.0;  // energy lost to friction of island and tip
  std::uint64_t yields = 0;
  double share = 1.0;  // share_of_load() when the island last yielded
  bool moved = false;
};

// Pushes an island by a base that goes from `from` to `to` at the height of `to`. `normal` is that of a contact at the
// start, a unit vector. The lever is loaded along and across; an island that yields follows the normal of the limit
// surface, tip and rim slip where friction across would exceed mu_t times the force along. Implicit in the forces, of
// second order in the turn of the normal, in steps of a small share of the distance of the axes.
IslandPath push_island(const LoneContact& contact, const IslandRim& rim, const IslandFriction& friction, const Flat& at,
                       const std::optional<Flat>& normal, const Flat& from, const Apex& to) noexcept;

}  // namespace afm::physics
