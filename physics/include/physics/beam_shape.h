// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

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

}  // namespace afm::physics
