// SPDX-License-Identifier: Apache-2.0
#include "series.h"

#include <algorithm>
#include <cmath>

namespace afm::fits {

// By Newton's method; F is convex, so that it comes from deeper from its second step on.
InSeries in_series(const Indenter& indenter, double modulus_pa, double spring_n_per_m, double way_m, double near_m) {
  constexpr int kMostSteps = 60;
  constexpr double kClose = 1e-7;  // the error of a step is the square
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

// With the root u of the depth, u^2 + c u^3 = way, by Halley's method: from either side no step passes beyond 0.
PressedLever::Pressed PressedLever::blunt_at(const Two& way_m, Two& root) const {
  constexpr int kMostSteps = 60;
  constexpr double kClose = 1e-4;  // the error of a step is about the cube
  const double stiffness = modulus_pa_ * power_->coefficient, bent = stiffness / spring_n_per_m_;
  for (int i = 0; i < kMostSteps; ++i) {
    const Two more = bent * root, off = root * root * (1.0 + more) - way_m;
    const Two slope = root * (2.0 + 3.0 * more), half = off * (1.0 + 3.0 * more);
    const Two step = off * slope / (slope * slope - half);
    root -= step;
    // also ends where a number is none
    if (!(std::abs(step[0]) > kClose * root[0] || std::abs(step[1]) > kClose * root[1])) break;
  }
  return {root * root, stiffness * root * root * root, 1.5 * stiffness * root};
}

// d + c d^2 = way
PressedLever::Pressed PressedLever::sharp_at(const Two& way_m) const {
  const double stiffness = modulus_pa_ * power_->coefficient, bent = stiffness / spring_n_per_m_;
  const Two square = 1.0 + 4.0 * bent * way_m;
  const Two depth_m = 2.0 * way_m / (1.0 + Two{std::sqrt(square[0]), std::sqrt(square[1])});
  return {depth_m, stiffness * depth_m * depth_m, 2.0 * stiffness * depth_m};
}

PressedLever::Pressed PressedLever::at(const Two& way_m, Two& root) const {
  if (power_) return power_->is_sharp ? sharp_at(way_m) : blunt_at(way_m, root);
  Pressed pressed;
  for (const int i : {0, 1}) {
    const auto [depth_m, push] = in_series(indenter_, modulus_pa_, spring_n_per_m_, way_m[i], root[i] * root[i]);
    root[i] = std::sqrt(depth_m);
    pressed.depth_m[i] = depth_m;
    pressed.force_n[i] = modulus_pa_ * push.force;
    pressed.slope_n_per_m[i] = modulus_pa_ * push.slope;
  }
  return pressed;
}

}  // namespace afm::fits
