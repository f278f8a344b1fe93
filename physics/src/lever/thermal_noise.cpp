// SPDX-License-Identifier: Apache-2.0
#include "physics/thermal_noise.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace afm::physics {
namespace {

using Complex = std::complex<double>;

// The integral of dr/(r^2 - p^2) from 0 to b.
Complex below_pole(double b, Complex p_squared) {
  const Complex p = std::sqrt(p_squared);
  return -std::atanh(b / p) / p;
}

// The integral of dr/((1 - r^2)^2 + (r/Q)^2) from 0 to b, in partial fractions of the two poles in r^2; pi Q/2 for b
// without bound.
double resonance_integral(double b, double quality_factor) {
  // the poles coincide at Q = 1/2; a relative change of 1e-6 there does not change the integral
  const double q = std::abs(quality_factor - 0.5) < 1e-6 ? 0.5 + 1e-6 : quality_factor;
  const double middle = 1.0 - 0.5 / (q * q);
  const Complex apart = std::sqrt(Complex(middle * middle - 1.0));
  const Complex upper = middle + apart, lower = middle - apart;
  return ((below_pole(b, upper) - below_pole(b, lower)) / (upper - lower)).real();
}

}  // namespace

Length thermal_deflection(Stiffness spring_constant, Temperature temperature) {
  return sqrt(thermal_energy(temperature) / spring_constant);
}

Force thermal_force(Stiffness spring_constant, Temperature temperature) {
  return spring_constant * thermal_deflection(spring_constant, temperature);
}

ForceSpectrum thermal_force_spectrum(Stiffness spring_constant, const LeverDynamics& lever) {
  const Frequency angular = 2.0 * std::numbers::pi * lever.resonance;
  return 4.0 / lever.quality_factor * (thermal_energy(lever.temperature) * spring_constant / angular);
}

Length thermal_deflection_below(Frequency bandwidth, Stiffness spring_constant, const LeverDynamics& lever) {
  const double share = 2.0 / (std::numbers::pi * lever.quality_factor) *
                       resonance_integral(bandwidth / lever.resonance, lever.quality_factor);
  return std::sqrt(share) * thermal_deflection(spring_constant, lever.temperature);
}

}  // namespace afm::physics
