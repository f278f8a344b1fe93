// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "lone_push.h"
#include "physics/manipulation/half_turn.h"

namespace afm::physics {

// Axis of a rod on the sample, seen from above, the centre of a sphere, or the flat part of an island. The body is
// everything within a radius of it, so that a tip meets a rod or an island as it meets a sphere at the nearest point.
struct Outline {
  Flat at;              // middle of the body
  Flat axis{1.0, 0.0};  // unit vector towards the front end
  double half_m = 0.0;  // half length of a rod; 0: no rod
  double core_m = 0.0;  // radius of the flat part; 0: no island
};

inline Flat along(const Outline& o, double way_m) noexcept {
  return {o.at.x + way_m * o.axis.x, o.at.y + way_m * o.axis.y};
}

// Position along the axis of its point nearest to `point`, from the middle.
inline double place_beside(const Outline& o, const Flat& point) noexcept {
  const double way_m = (point.x - o.at.x) * o.axis.x + (point.y - o.at.y) * o.axis.y;
  return std::clamp(way_m, -o.half_m, o.half_m);
}

inline Flat nearest_on_core(const Outline& island, const Flat& point) noexcept {
  const double away_m = distance_between(island.at, point);
  if (away_m <= island.core_m) return point;
  const double share = island.core_m / away_m;
  return {island.at.x + share * (point.x - island.at.x), island.at.y + share * (point.y - island.at.y)};
}

inline Flat nearest_on(const Outline& o, const Flat& point) noexcept {
  if (o.core_m > 0.0) return nearest_on_core(o, point);
  return o.half_m > 0.0 ? along(o, place_beside(o, point)) : o.at;
}

// Returns whether two axes cross.
inline bool cross(const Outline& a, const Outline& b) noexcept {
  if (!(a.half_m > 0.0 && b.half_m > 0.0)) return false;
  const auto side = [](const Outline& o, const Flat& p) {
    return o.axis.x * (p.y - o.at.y) - o.axis.y * (p.x - o.at.x);
  };
  const auto apart = [&](const Outline& o, const Outline& other) {
    return side(o, along(other, -other.half_m)) * side(o, along(other, other.half_m)) > 0.0;
  };
  return !apart(a, b) && !apart(b, a);
}

// Distance of two axes that do not cross, or of the flat parts of two islands.
inline double distance_between(const Outline& a, const Outline& b) noexcept {
  if (a.core_m > 0.0 || b.core_m > 0.0) {
    return std::max(0.0, distance_between(a.at, b.at) - a.core_m - b.core_m);
  }
  if (!(b.half_m > 0.0)) return distance_between(nearest_on(a, b.at), b.at);
  if (!(a.half_m > 0.0)) return distance_between(a.at, nearest_on(b, a.at));
  double least_m = HUGE_VAL;
  for (const double end : {-1.0, 1.0}) {
    const Flat of_a = along(a, end * a.half_m), of_b = along(b, end * b.half_m);
    least_m =
        std::min({least_m, distance_between(of_a, nearest_on(b, of_a)), distance_between(of_b, nearest_on(a, of_b))});
  }
  return least_m;
}

inline Flat axis_of(const HalfTurn& turn) noexcept {
  return {turn.w * turn.w - turn.z * turn.z, 2.0 * turn.w * turn.z};
}

// Tangent of half the angle by which a rod turns whose ends move across by `turned_m`.
inline double half_tangent(double turned_m, double half_m) noexcept { return 0.5 * turned_m / half_m; }

inline HalfTurn turned(const HalfTurn& turn, double tangent) noexcept {
  const double w = turn.w - turn.z * tangent, z = turn.z + turn.w * tangent, size = std::sqrt(w * w + z * z);
  return {w / size, z / size};
}

inline Flat turned(const Flat& axis, double tangent) noexcept {
  const double scale = 1.0 / (1.0 + tangent * tangent);
  const double cosine = (1.0 - tangent * tangent) * scale, sine = 2.0 * tangent * scale;
  return {cosine * axis.x - sine * axis.y, sine * axis.x + cosine * axis.y};
}

}  // namespace afm::physics
