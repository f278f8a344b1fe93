// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "physics/units.h"

// The shape of a cantilever under a load at its end: Euler-Bernoulli beam, clamped at x = 0, loaded at x = L, straight
// beyond the load and at rest before the clamp (Gere & Timoshenko, Mechanics of Materials, table of cantilever
// deflections). Small deflections. The only C++ implementation; shaders/beam.glsl is the same, and a test compares the
// two. Any thread.
namespace afm::physics {

// w(x)/w(L) = (3 xi^2 - xi^3)/2 with xi = x/L.
constexpr double beam_deflection(double xi) {
  const double loaded = std::clamp(xi, 0.0, 1.0);
  return 0.5 * loaded * loaded * (3.0 - loaded) + 1.5 * std::max(xi - 1.0, 0.0);
}

// d(w/w(L))/d(xi) = (6 xi - 3 xi^2)/2; 3/2 at the end and beyond.
constexpr double beam_slope(double xi) {
  const double loaded = std::clamp(xi, 0.0, 1.0);
  return 1.5 * loaded * (2.0 - loaded);
}

// dw/dx at the end, 3 w(L)/(2 L): the tangent of the angle of the end and the tip.
constexpr double end_slope(Length lever_length, Length end_deflection) {
  return beam_slope(1.0) * (end_deflection / lever_length);
}

// Displacement of the reflected spot of an optical lever on a detector at distance s from the lever's end. A mirror
// rotates a ray by twice its own angle: 2 s end_slope = 3 s w(L)/L.
constexpr Length spot_displacement(Length lever_length, Length detector_distance, Length end_deflection) {
  return 2.0 * end_slope(lever_length, end_deflection) * detector_distance;
}

}  // namespace afm::physics
