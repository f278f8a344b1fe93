// SPDX-License-Identifier: Apache-2.0
#include "app/bench/runge_kutta_tip.h"

#include <cmath>
#include <numbers>

namespace afm::app {

double RungeKuttaTip::swing(int swings, int steps) {
  const double step = 2.0 * std::numbers::pi / steps, drive = free_amplitude / quality_factor;
  const double stiff = 4.0 / 3.0 * reduced_modulus * std::sqrt(tip_radius), pull = hamaker * tip_radius / 6.0;
  const auto force = [&](double height) {
    if (height > contact_gap) return -pull / (height * height);
    const double depth = contact_gap - height;
    return stiff * depth * std::sqrt(depth) - pull / (contact_gap * contact_gap);
  };
  const auto acceleration = [&](double driven, double position, double velocity) {
    return driven - velocity / quality_factor - position + force(z + position) / spring_constant;
  };
  double cosine = 0.0, sine = 0.0;
  for (int n = 0; n < swings; ++n) {
    cosine = sine = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double angle = step * i;
      const double first = drive * std::cos(angle), half = drive * std::cos(angle + 0.5 * step),
                   last = drive * std::cos(angle + step);
      cosine += x * std::cos(angle);
      sine += x * std::sin(angle);
      const double a1 = acceleration(first, x, v);
      const double v2 = v + 0.5 * step * a1, a2 = acceleration(half, x + 0.5 * step * v, v2);
      const double v3 = v + 0.5 * step * a2, a3 = acceleration(half, x + 0.5 * step * v2, v3);
      const double v4 = v + step * a3, a4 = acceleration(last, x + step * v3, v4);
      x += step / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
      v += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
  }
  return 2.0 / steps * std::hypot(cosine, sine);
}

}  // namespace afm::app
