// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/lever_dynamics.h"
#include "physics/units.h"

namespace afm::physics {

// The swing of the lever's base that drives it, given by what an instrument shows.
struct Drive {
  Length free_amplitude;  // A0, amplitude zero-to-peak at the drive frequency and far from the sample
  Frequency frequency;    // f_d, frequency of the drive
};

// Frequency at which averages let the higher harmonics of a swing answer. AtResonance, whatever the drive, is that of
// recordings before session version 21, which replay bit for bit: 6 % above the resonance amplitudes are 1 % off.
enum class Harmonics { OfTheDrive, AtResonance };

// Z of the event of a jump off under a hand. WherePhaseCrossed is that of recordings before session version 22, which
// replay bit for bit: a swing that falls onto the free one crosses its phase nowhere, and had the Z of the jump before.
enum class JumpOff { WhereSeen, WherePhaseCrossed };

// A lever under its drive. With x the deflection of the tip, positive away from the sample, and time in 1/w0:
//
//   x'' + x'/Q + x = a cos(r t) + F/k,   r = f_d/f0,   a = A0 sqrt((1-r^2)^2 + (r/Q)^2).
//
// The first harmonic is x0 + A cos(r t - phi): A is zero-to-peak, and the phase phi is the lag behind the drive, 90
// degrees for a free lever at f0, more where the sample attracts on balance, and less where it repels.
struct DrivenLever {
  Stiffness spring_constant;
  Frequency resonance;
  double quality_factor = 1.0;
  double ratio = 1.0;  // r = f_d/f0, drive over resonance
  Length free_amplitude;
  Length base_amplitude;    // a, amplitude of the base
  double free_phase = 0.0;  // lag of the free lever behind its drive, rad
  Harmonics harmonics = Harmonics::OfTheDrive;
  JumpOff jump_off = JumpOff::WhereSeen;

  double angular_resonance() const noexcept;  // w0, angular resonance in rad/s
  double angular_drive() const noexcept;      // r w0, angular drive frequency in rad/s
  Time relaxation() const noexcept;           // 2Q/w0, of any small change of a swing under a conservative force

  bool operator==(const DrivenLever&) const = default;
};

// Throws UnphysicalValue unless the lever is valid, Q is within 0.5 to 1e5, A0 within 10 pm to 10 um, and f_d within
// 0.5 f0 to 1.5 f0.
DrivenLever driven_lever(Stiffness spring_constant, const LeverDynamics& lever, const Drive& drive);

// Energy lost to the sample in a swing, by Cleveland et al. 1998 from amplitude and phase only:
//
//   E = pi k r A^2/Q (Q a sin(phi)/(r A) - 1).
//
// It counts what the higher harmonics lose to the air as lost to the sample.
Energy cleveland_energy(const DrivenLever& lever, Length amplitude, double phase_rad) noexcept;

}  // namespace afm::physics
