// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::app {

// A tapping tip in its simplest form: the reference of `touchafm bench tapping`. Van der Waals above
// contact and DMT below, a lever at its resonance, four forces per step (Runge-Kutta). SI units; time in 1/w0.
struct RungeKuttaTip {
  double spring_constant = 0, quality_factor = 0, free_amplitude = 0;
  double tip_radius = 0, hamaker = 0, reduced_modulus = 0, contact_gap = 0;
  double z = 0;         // height of the base
  double x = 0, v = 0;  // deflection and its rate at the drive's angle of zero

  // Zero-to-peak amplitude of the first harmonic over the last of `swings` swings of `steps` steps.
  double swing(int swings, int steps);
};

}  // namespace afm::app
