// SPDX-License-Identifier: Apache-2.0
#pragma once

// The free flexural modes of a rectangular cantilever, counted from 1, and their shares of the thermal noise (Butt &
// Jaschke 1995). Any thread. A mode below 1 throws std::invalid_argument.
namespace afm::physics {

// alpha_i: the i-th root of cos(a) cosh(a) = -1, the mode's wave number times the length.
double flexural_root(int mode);

// 12/alpha_i^4: the mode's share of the mean square deflection k_B T/k of the free end.
double thermal_share(int mode);

// The mode's share of k_B T/k in the deflection indicated by an optical lever that was calibrated under an end load.
// Such a lever measures the slope: (16/(3 alpha^2)) (sin(a) sinh(a)/(sin(a) + sinh(a)))^2. The shares of all modes add
// up to 4/3.
double virtual_thermal_share(int mode);

// chi = sqrt(thermal_share/virtual_thermal_share): ratio of the inverse optical lever sensitivity of a free mode to
// that of the end-loaded lever.
double optical_lever_ratio(int mode);

}  // namespace afm::physics
