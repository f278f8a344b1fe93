// SPDX-License-Identifier: Apache-2.0
#include "physics/flexural_modes.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace afm::physics {

double flexural_root(int mode) {
  if (mode < 1) throw std::invalid_argument("flexural mode " + std::to_string(mode) + " is not 1 or more");
  // Newton's method on cos(a) + 1/cosh(a) from the root of the cosine, to which the higher modes are very close
  double a = (mode - 0.5) * std::numbers::pi;
  for (int i = 0; i < 8; ++i) {
    const double sech = 1.0 / std::cosh(a);
    a += (std::cos(a) + sech) / (std::sin(a) + std::tanh(a) * sech);
  }
  return a;
}

double thermal_share(int mode) { return 12.0 / std::pow(flexural_root(mode), 4); }

double virtual_thermal_share(int mode) {
  const double a = flexural_root(mode);
  // sin sinh/(sin + sinh), divided through by sinh, which overflows for a high mode
  const double slope = std::sin(a) / (std::sin(a) / std::sinh(a) + 1.0);
  return 16.0 / (3.0 * a * a) * slope * slope;
}

double optical_lever_ratio(int mode) { return std::sqrt(thermal_share(mode) / virtual_thermal_share(mode)); }

}  // namespace afm::physics
