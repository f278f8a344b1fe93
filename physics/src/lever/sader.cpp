// SPDX-License-Identifier: Apache-2.0
#include "physics/sader.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

namespace afm::physics {
namespace {

using Complex = std::complex<double>;

// K1(z)/K0(z) of the modified Bessel functions for Re(z) > 0. Both are the integral of exp(-z cosh t) cosh(nu t) over t
// from 0 on; its integrand decays doubly exponentially, so the trapezoidal rule reaches full precision.
Complex bessel_k_ratio(Complex z) {
  constexpr double kStep = 0.02;
  constexpr double kNegligible = 45.0;  // exponent beyond which exp(-x) is below the last bit

  Complex k0 = 0.5, k1 = 0.5;  // terms at t = 0 of exp(z) K(z)
  for (int i = 1;; ++i) {
    const double t = kStep * i;
    const Complex exponent = -z * (std::cosh(t) - 1.0);
    if (exponent.real() + t < -kNegligible) return k1 / k0;
    const Complex value = std::exp(exponent);
    k0 += value;
    k1 += value * std::cosh(t);
  }
}

double polynomial(std::span<const double> ascending, double x) {
  double value = 0.0;
  for (std::size_t i = ascending.size(); i-- > 0;) value = value * x + ascending[i];
  return value;
}

// Omega(Re): correction from a cylinder to a thin plate (Sader 1998, equation 21).
Complex plate_correction(double reynolds) {
  constexpr std::array kRealOver{0.91324, -0.48274, 0.46842, -0.12886, 0.044055, -0.0035117, 0.00069085};
  constexpr std::array kRealUnder{1.0, -0.56964, 0.48690, -0.13444, 0.045155, -0.0035862, 0.00069085};
  constexpr std::array kImaginaryOver{-0.024134, -0.029256, 0.016294, -0.00010961, 0.000064577, -0.000044510};
  constexpr std::array kImaginaryUnder{1.0, -0.59702, 0.55182, -0.18357, 0.079156, -0.014369, 0.0028361};
  const double tau = std::log10(reynolds);
  return {polynomial(kRealOver, tau) / polynomial(kRealUnder, tau),
          polynomial(kImaginaryOver, tau) / polynomial(kImaginaryUnder, tau)};
}

}  // namespace

std::complex<double> hydrodynamic_function(double reynolds) {
  // written so that NaN fails
  if (!(reynolds >= 1e-6 && reynolds <= 1e4)) {
    throw std::invalid_argument("the hydrodynamic function is known for Reynolds numbers of 1e-6 to 1e4, not for " +
                                std::to_string(reynolds));
  }
  // sqrt(i Re), and -i times it, in whose half plane K0 and K1 decay
  const Complex root = std::polar(std::sqrt(reynolds), 0.25 * std::numbers::pi);
  const Complex argument = std::polar(std::sqrt(reynolds), -0.25 * std::numbers::pi);
  const Complex cylinder = 1.0 + Complex(0.0, 4.0) * bessel_k_ratio(argument) / root;
  return plate_correction(reynolds) * cylinder;
}

Stiffness sader_spring_constant(Length length, Length width, Frequency resonance, double quality_factor,
                                const Fluid& fluid) {
  const Frequency angular = 2.0 * std::numbers::pi * resonance;
  const double reynolds = 0.25 * (fluid.density * angular * width * width / fluid.viscosity);
  return 0.1906 * quality_factor * hydrodynamic_function(reynolds).imag() *
         (fluid.density * width * width * length * angular * angular);
}

}  // namespace afm::physics
