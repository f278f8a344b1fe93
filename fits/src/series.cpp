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

}  // namespace afm::fits
