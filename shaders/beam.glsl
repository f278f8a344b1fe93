// SPDX-License-Identifier: Apache-2.0
// Shape of an end-loaded, clamped beam: w(x)/w(L) = (3 xi^2 - xi^3)/2 with xi = x/L (Euler-Bernoulli; Gere and
// Timoshenko, "Mechanics of Materials", table of cantilever deflections). Beyond the load the beam is straight; before
// the clamp it does not move. Displacement along +z of the node; `bend` as in DrawBlock. Same as physics/beam_shape.h:
// a test compiles this file as C++ and compares.

float beam_deflection(vec4 bend, float x) {
  float xi = clamp(x * bend.x, 0.0, 1.0);
  float beyond = max(x * bend.x - 1.0, 0.0);
  return bend.y * (0.5 * xi * xi * (3.0 - xi) + 1.5 * beyond);
}

float beam_slope(vec4 bend, float x) {
  float xi = clamp(x * bend.x, 0.0, 1.0);
  return bend.y * bend.x * 1.5 * xi * (2.0 - xi);
}
