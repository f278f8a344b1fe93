// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "physics/units.h"

// The tip on a row of atoms (Prandtl 1928, Tomlinson 1929), pulled by a spring k so slowly that it is always at rest:
//
//   V = -(E0/2) cos(2 pi x/a) + (k/2) (x - X)^2
//
// x is the tip's position, X the support's. All results are exact for the sine, without thermal noise. Any thread;
// lengths, energies and stiffnesses must be positive.
namespace afm::physics {

struct SineLattice {
  Length period;     // a
  Energy amplitude;  // E0, from a well to the saddle between two
  Stiffness spring;  // k
};

// eta = 2 pi^2 E0/(k a^2): the tip slips if it is above 1, otherwise it follows without a loss (Socoliuc et al. 2004).
double slip_parameter(const SineLattice& lattice);

// pi E0/a, at x = a/4; if eta > 1 the slip comes later.
Force largest_lateral_force(const SineLattice& lattice);

// dF/dX of a tip at rest in a well: k eta/(1 + eta).
Stiffness slope_at_rest(const SineLattice& lattice);

// The slip out of the well at 0, towards the well at a.
struct SineSlip {
  Length support;      // X
  Length tip_before;   // x
  Length tip_after;    // in the next well, even if there are more: an overdamped tip
  Force force_before;  // k (X - x): (k a/2 pi) sqrt(eta^2 - 1)
  Force force_after;
  Energy lost;  // decrease of V
};

// Empty if eta <= 1.
std::optional<SineSlip> first_slip(const SineLattice& lattice);

// Mean lateral force on a tip pulled along the row: the energy of a slip divided by the period, 0 if eta <= 1.
Force mean_friction(const SineLattice& lattice);

// Energy lost in one stroke back and forth, without the effect of the turning points: twice the mean friction's work.
Energy loop_energy(const SineLattice& lattice, Length stroke);

// The remaining barrier at the distance `before` from the support's position at the slip, and the force there. It
// vanishes as the 3/2-th power of the missing force (Sang, Dube & Grant 2001). For eta > 1 and `before` from 0 to the
// place where the tip leaves the well on the other side.
struct SlipBarrier {
  Energy height;
  Force force;
};
SlipBarrier barrier_before_slip(const SineLattice& lattice, Length before);

// The lattice of a friction loop, from its period, its largest force and its slope at rest k_exp (Socoliuc et al.
// 2004): E0 = a F/pi, eta = 2 pi F/(k_exp a) - 1, k = k_exp (1 + 1/eta). Throws std::invalid_argument if the force is
// too weak for a positive eta.
SineLattice lattice_of_loop(Length period, Force largest, Stiffness slope_at_rest);

}  // namespace afm::physics
