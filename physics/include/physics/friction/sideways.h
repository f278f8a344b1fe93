// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "physics/units.h"

namespace afm::physics {

// A quantity in the plane of the sample, along its x and y axes.
template <class Q>
struct Sideways {
  Q x;
  Q y;

  constexpr Sideways operator+(const Sideways& other) const { return {x + other.x, y + other.y}; }
  constexpr Sideways operator-(const Sideways& other) const { return {x - other.x, y - other.y}; }
  constexpr Sideways operator*(double factor) const { return {x * factor, y * factor}; }
  constexpr bool operator==(const Sideways&) const = default;
};

template <class P, class Q>
constexpr auto dot(const Sideways<P>& a, const Sideways<Q>& b) {
  return a.x * b.x + a.y * b.y;
}

template <class Q>
Q magnitude(const Sideways<Q>& v) {
  return Q(std::hypot(v.x.si, v.y.si));
}

}  // namespace afm::physics
