// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>

#include "physics/units.h"

namespace afm::physics {

// The fluid around a lever. Air at 20 degrees Celsius: 1.2 kg/m^3, 18 uPa s.
struct Fluid {
  Density density;
  Viscosity viscosity;
};

// Gamma(Re) of a thin, long rectangular lever that oscillates across its width b in a viscous fluid, with
// Re = rho w b^2/(4 eta): Gamma of a circular cylinder by Bessel functions times the rational fit in log10(Re) of Sader
// 1998 (J. Appl. Phys. 84, 64, equations 20 and 21), good to 0.1 % for Re from 1e-6 to 1e4. The real part is added
// mass, the imaginary part damping. Throws std::invalid_argument for another Re.
std::complex<double> hydrodynamic_function(double reynolds);

// The spring constant of a rectangular lever from its plan view and its resonance in a fluid (Sader, Chon & Mulvaney
// 1999): k = 0.1906 rho b^2 L Q Im(Gamma) w^2, w = 2 pi f. For L/b above about 3 and Q well above 1. Throws as
// hydrodynamic_function does.
Stiffness sader_spring_constant(Length length, Length width, Frequency resonance, double quality_factor,
                                const Fluid& fluid);

}  // namespace afm::physics
