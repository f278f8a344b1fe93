// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "physics/units.h"

// The tip on a row of atoms (Prandtl 1928, Tomlinson 1929), pulled by a spring k so slowly that it always rests:
//
//   V = -(E0/2) cos(2 pi x/a) + (k/2) (x - X)^2
//
// x is the tip's place, X the support's. All here is exact for the sine; quantities without thermal noise. For any
// thread; lengths, energies and stiffnesses above zero.
namespace afm::physics {

struct SineLattice {
  Length period;     // a
  Energy amplitude;  // E0, from a well to the saddle between two
  Stiffness spring;  // k
};

// eta = 2 pi^2 E0/(k a^2): the tip slips if it is above 1, and else follows without a loss (Socoliuc et al. 2004).
double slip_parameter(const SineLattice& lattice);

// pi E0/a, at x = a/4; with eta > 1 the slip comes later.
Force largest_lateral_force(const SineLattice& lattice);

// dF/dX of a tip at rest in a well: k eta/(1 + eta).
Stiffness slope_at_rest(const SineLattice& lattice);

// The slip out of the well at 0, towards the well at a.
struct SineSlip {
  Length support;      // X
  Length tip_before;   // x
  Length tip_after;    // in the next well, however many others there are: an overdamped tip
  Force force_before;  // k (X - x): (k a/2 pi) sqrt(eta^2 - 1)
  Force force_after;
  Energy lost;  // the drop of V
};

// None for eta <= 1.
std::optional<SineSlip> first_slip(const SineLattice& lattice);

// What a tip that is pulled along the row is held back by on average: the energy of a slip over the period, 0 for
// eta <= 1.
Force mean_friction(const SineLattice& lattice);

// Lost by one stroke there and back without what the turning points add or spare: twice the mean friction's work.
Energy loop_energy(const SineLattice& lattice, Length stroke);

// The barrier that is left where the support is `before` its place at the slip, and the force there. It vanishes as
// the 3/2-th power of the missing force (Sang, Dube & Grant 2001). For eta > 1 and 0 <= before, up to the place where
// the tip leaves the well of the other side.
struct SlipBarrier {
  Energy height;
  Force force;
};
SlipBarrier barrier_before_slip(const SineLattice& lattice, Length before);

// The lattice of a friction loop, from its period, its largest force and its slope at rest k_exp (Socoliuc et al.
// 2004): E0 = a F/pi, eta = 2 pi F/(k_exp a) - 1, k = k_exp (1 + 1/eta). Throws std::invalid_argument where the force
// is so weak that eta would not be above zero.
SineLattice lattice_of_loop(Length period, Force largest, Stiffness slope_at_rest);

}  // namespace afm::physics
