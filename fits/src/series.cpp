// SPDX-License-Identifier: Apache-2.0
#include "series.h"

#include <algorithm>
#include <cmath>

namespace afm::fits {

// Solves by Newton's method; F is convex, so that it approaches from deeper from its second step on.
InSeries in_series(const Indenter& indenter, double modulus_pa, double spring_n_per_m, double way_m, double near_m) {
  constexpr int kMostSteps = 60;
  constexpr double kClose = 1e-7;  // size of the last step, whose error is its square
  double depth_m = std::clamp(near_m, 0.01 * way_m, way_m);
  Push push;
  for (int step = 0; step < kMostSteps; ++step) {
    push = push_of(indenter, depth_m);
    const double off_m = depth_m + modulus_pa * push.force / spring_n_per_m - way_m;
    const double next_m = depth_m - off_m / (1.0 + modulus_pa * push.slope / spring_n_per_m);
    const double change_m = next_m - depth_m;
    depth_m = next_m > 0.0 ? std::min(next_m, way_m) : 0.5 * depth_m;
    if (std::abs(change_m) > kClose * depth_m) continue;
    push.force += push.slope * change_m;
    break;
  }
  return {depth_m, push};
}

PressedLever::PressedLever(const Indenter& indenter, double modulus_pa, double spring_n_per_m)
    : indenter_(indenter), power_(power_law_of(indenter)), modulus_pa_(modulus_pa), spring_n_per_m_(spring_n_per_m) {}

// Solves u^2 + c u^3 = way for the root u of the depth by Halley's method: from either side no step passes beyond 0.
// Two pairs, so that one is worked on while the other waits for a division.
void PressedLever::blunt_at(const Four& way_m, Four& root, Pressed& pressed) const {
  constexpr int kMostSteps = 60;
  constexpr double kClose = 1e-4;  // size of the last step, whose error is about its cube
  const double stiffness = modulus_pa_ * power_->coefficient, bent = stiffness / spring_n_per_m_;
  Four u(root);
  for (int i = 0; i < kMostSteps; ++i) {
    Four far{};
    unrolled<2>([&](auto k) {
      const Two more = bent * u[k], off = u[k] * u[k] * (1.0 + more) - way_m[k];
      const Two slope = u[k] * (2.0 + 3.0 * more), half = off * (1.0 + 3.0 * more);
      const Two step = off * slope / (slope * slope - half);
      u[k] -= step;
      // by squares, which have no sign
      far[k] = step * step - (kClose * kClose) * (u[k] * u[k]);
    });
    // also ends where a number is none
    if (!(far[0][0] > 0.0 || far[0][1] > 0.0 || far[1][0] > 0.0 || far[1][1] > 0.0)) break;
  }
  unrolled<2>([&](auto k) {
    pressed.depth_m[k] = u[k] * u[k];
    pressed.force_n[k] = stiffness * u[k] * u[k] * u[k];
    pressed.slope_n_per_m[k] = 1.5 * stiffness * u[k];
  });
  root = u;
}

// Solves d + c d^2 = way.
void PressedLever::sharp_at(const Four& way_m, Pressed& pressed) const {
  const double stiffness = modulus_pa_ * power_->coefficient, bent = stiffness / spring_n_per_m_;
  unrolled<2>([&](auto k) {
    const Two square = 1.0 + 4.0 * bent * way_m[k];
    const Two depth_m = 2.0 * way_m[k] / (1.0 + Two{std::sqrt(square[0]), std::sqrt(square[1])});
    pressed.depth_m[k] = depth_m;
    pressed.force_n[k] = stiffness * depth_m * depth_m;
    pressed.slope_n_per_m[k] = 2.0 * stiffness * depth_m;
  });
}

void PressedLever::at(const Four& way_m, Four& root, Pressed& pressed) const {
  if (power_) return power_->is_sharp ? sharp_at(way_m, pressed) : blunt_at(way_m, root, pressed);
  for (std::size_t i = 0; i < kAtOnce; ++i) {
    const std::size_t k = i / 2;
    const int of_pair = i % 2 == 0 ? 0 : 1;
    const double near_m = root[k][of_pair] * root[k][of_pair];
    const auto [depth_m, push] = in_series(indenter_, modulus_pa_, spring_n_per_m_, way_m[k][of_pair], near_m);
    root[k][of_pair] = std::sqrt(depth_m);
    pressed.depth_m[k][of_pair] = depth_m;
    pressed.force_n[k][of_pair] = modulus_pa_ * push.force;
    pressed.slope_n_per_m[k][of_pair] = modulus_pa_ * push.slope;
  }
}

}  // namespace afm::fits
