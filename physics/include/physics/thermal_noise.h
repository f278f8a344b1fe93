// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/lever_dynamics.h"
#include "physics/units.h"

// Thermal noise of a free lever, from equipartition and the fluctuation-dissipation theorem. The shares of the flexural
// modes are in physics/flexural_modes.h. Any thread.
namespace afm::physics {

// sqrt(k_B T/k): root mean square of the deflection.
Length thermal_deflection(Stiffness spring_constant, Temperature temperature);

// sqrt(k_B T k): root mean square of the force on the lever.
Force thermal_force(Stiffness spring_constant, Temperature temperature);

// Power density of the thermal force, one-sided: 4 k_B T k/(w0 Q). White.
using ForceSpectrum = Quantity<2, 2, -3>;
ForceSpectrum thermal_force_spectrum(Stiffness spring_constant, const LeverDynamics& lever);

// Root mean square of the deflection between 0 and `bandwidth`: the noise after an ideal low pass, such as a haptic
// loop of twice that rate. The integral of the one-sided spectrum of the damped oscillator.
Length thermal_deflection_below(Frequency bandwidth, Stiffness spring_constant, const LeverDynamics& lever);

}  // namespace afm::physics
