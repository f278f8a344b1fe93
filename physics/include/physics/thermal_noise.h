// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/lever_dynamics.h"
#include "physics/units.h"

// What heat does to a lever that touches nothing, by equipartition and the fluctuation-dissipation theorem. Which part
// of it each flexural mode takes is in physics/flexural_modes.h. For any thread.
namespace afm::physics {

// sqrt(k_B T/k): root mean square of the deflection.
Length thermal_deflection(Stiffness spring_constant, Temperature temperature);

// sqrt(k_B T k): the same as a force on the lever.
Force thermal_force(Stiffness spring_constant, Temperature temperature);

// Force squared a hertz, one-sided: 4 k_B T k/(w0 Q). White.
using ForceSpectrum = Quantity<2, 2, -3>;
ForceSpectrum thermal_force_spectrum(Stiffness spring_constant, const LeverDynamics& lever);

// The root mean square deflection between 0 and `bandwidth`: what is left of the noise behind an ideal low pass, as a
// haptic loop of twice that rate has one. The integral of the one-sided spectrum of the damped oscillator.
Length thermal_deflection_below(Frequency bandwidth, Stiffness spring_constant, const LeverDynamics& lever);

}  // namespace afm::physics
