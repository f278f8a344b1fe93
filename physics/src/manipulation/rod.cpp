// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/rod.h"

#include <cmath>
#include <numbers>

namespace afm::physics {

Length rod_pivot(Length length, Length place) noexcept {
  const double s = std::abs(place.si), half = 0.5 * length.si;
  // without the difference of two nearly equal numbers
  return Length(half * half / (std::sqrt(s * s + half * half) + s));
}

Force rod_threshold(Force sideways, Length length, Length place) noexcept {
  return sideways * (2.0 * (rod_pivot(length, place) / length));
}

Length longest_rigid_rod(Stiffness friction_per_length, Pressure modulus, Length radius) noexcept {
  const double bending_m4 = 32.0 * std::numbers::pi * std::pow(radius.si, 4.0);  // denominator 128 I, in m^4
  return Length(std::cbrt(kRigidShare * modulus.si * bending_m4 / friction_per_length.si));
}

}  // namespace afm::physics
