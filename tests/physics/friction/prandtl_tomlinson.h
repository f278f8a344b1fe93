// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "physics/friction/lattice_tip.h"
#include "physics/units.h"

// The tip on a row of atoms (Prandtl 1928, Tomlinson 1929), pulled by a spring k so slowly that it is always at rest:
//
//   V = -(E0/2) cos(2 pi x/a) + (k/2) (x - X)^2
//
// x is the tip's place, X the support's. All here is exact for the sine; quantities without thermal noise. Lengths,
// energies and stiffnesses above zero. Tests compare the tips of physics/friction with it.
namespace afm::physics {

struct SineLattice {
  Length period;     // lattice period a
  Energy amplitude;  // E0, energy from a well to the saddle between two
  Stiffness spring;  // spring constant k
};

inline constexpr double kTurn = 2.0 * std::numbers::pi;

inline double wave_number(const SineLattice& lattice) { return kTurn / lattice.period.si; }

// eta = 2 pi^2 E0/(k a^2): the tip slips if it is above 1, otherwise it follows without a loss (Socoliuc et al. 2004).
inline double slip_parameter(const SineLattice& lattice) {
  const double q = wave_number(lattice);
  return 0.5 * lattice.amplitude.si * q * q / lattice.spring.si;
}

// U of a lattice whose largest force along x equals that of a row of the amplitude E0: E0/4 for Hexagonal, otherwise
// E0/2.
inline Energy scale_of_row(LatticeKind kind, Energy amplitude) {
  return (kind == LatticeKind::Hexagonal ? 0.25 : 0.5) * amplitude;
}

inline double potential_of(const SineLattice& lattice, double tip_m, double support_m) {
  const double stretch_m = tip_m - support_m;
  return -0.5 * lattice.amplitude.si * std::cos(wave_number(lattice) * tip_m) +
         0.5 * lattice.spring.si * stretch_m * stretch_m;
}

// Slope of the potential, dV/dx.
inline double slope_of(const SineLattice& lattice, double tip_m, double support_m) {
  const double q = wave_number(lattice);
  return 0.5 * lattice.amplitude.si * q * std::sin(q * tip_m) + lattice.spring.si * (tip_m - support_m);
}

// Zero of dV/dx between two places at which it has opposite signs.
inline double rest_between(const SineLattice& lattice, double low_m, double high_m, double support_m) {
  const bool rising = slope_of(lattice, high_m, support_m) > 0.0;
  for (int i = 0; i < 200 && low_m < high_m; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    if (middle_m <= low_m || middle_m >= high_m) break;
    ((slope_of(lattice, middle_m, support_m) > 0.0) == rising ? high_m : low_m) = middle_m;
  }
  return 0.5 * (low_m + high_m);
}

// Place where the curvature of the potential vanishes: cos(q x) = -1/eta.
inline double tip_at_slip(const SineLattice& lattice) {
  return std::acos(-1.0 / slip_parameter(lattice)) / wave_number(lattice);
}

// Largest lateral force, pi E0/a, at x = a/4; if eta > 1 the slip comes later.
inline Force largest_lateral_force(const SineLattice& lattice) {
  return std::numbers::pi * lattice.amplitude / lattice.period;
}

// Slope of the force, dF/dX, for a tip at rest in a well: k eta/(1 + eta).
inline Stiffness slope_at_rest(const SineLattice& lattice) {
  const double eta = slip_parameter(lattice);
  return eta / (1.0 + eta) * lattice.spring;
}

// Slip out of the well at 0, towards the well at a.
struct SineSlip {
  Length support;      // position X of the support
  Length tip_before;   // position x of the tip
  Length tip_after;    // position in the next well, even if there are more: an overdamped tip
  Force force_before;  // k (X - x): (k a/2 pi) sqrt(eta^2 - 1)
  Force force_after;
  Energy lost;  // decrease of V
};

// First slip; none for eta <= 1.
inline std::optional<SineSlip> first_slip(const SineLattice& lattice) {
  const double eta = slip_parameter(lattice);
  if (!(eta > 1.0)) return std::nullopt;
  const double a = lattice.period.si, k = lattice.spring.si;
  const double before = tip_at_slip(lattice);
  const double force = k / wave_number(lattice) * std::sqrt(eta * eta - 1.0);
  const double support = before + force / k;
  // in the next well the tip lies between the place where its curvature begins and the place of the next slip
  const double after = rest_between(lattice, a - before, a + before, support);
  return SineSlip{.support = Length(support),
                  .tip_before = Length(before),
                  .tip_after = Length(after),
                  .force_before = Force(force),
                  .force_after = Force(k * (support - after)),
                  .lost = Energy(potential_of(lattice, before, support) - potential_of(lattice, after, support))};
}

// Mean lateral force on a tip pulled along the row: the energy of a slip divided by the period, 0 if eta <= 1.
inline Force mean_friction(const SineLattice& lattice) {
  const auto slip = first_slip(lattice);
  return slip ? slip->lost / lattice.period : Force();
}

// Energy lost in one stroke back and forth, without the effect of the turning points: twice the mean friction's work.
inline Energy loop_energy(const SineLattice& lattice, Length stroke) { return 2.0 * mean_friction(lattice) * stroke; }

// The remaining barrier at the distance `before` from the support's position at the slip, and the force there. It
// vanishes as the 3/2-th power of the missing force (Sang, Dube & Grant 2001). For eta > 1 and `before` from 0 to the
// place where the tip leaves the well on the other side.
struct SlipBarrier {
  Energy height;
  Force force;
};
inline SlipBarrier barrier_before_slip(const SineLattice& lattice, Length before) {
  const double slip_m = tip_at_slip(lattice);
  const double support = first_slip(lattice).value().support.si - before.si;
  const double rest = rest_between(lattice, -slip_m, slip_m, support);
  const double top = rest_between(lattice, slip_m, lattice.period.si - slip_m, support);
  return {.height = Energy(potential_of(lattice, top, support) - potential_of(lattice, rest, support)),
          .force = Force(lattice.spring.si * (support - rest))};
}

// The lattice of a friction loop, from its period, its largest force and its slope at rest k_exp (Socoliuc et al.
// 2004): E0 = a F/pi, eta = 2 pi F/(k_exp a) - 1, k = k_exp (1 + 1/eta). Throws std::invalid_argument if the force is
// too weak for a positive eta.
inline SineLattice lattice_of_loop(Length period, Force largest, Stiffness slope_at_rest) {
  const double eta = kTurn * (largest / (slope_at_rest * period)) - 1.0;
  if (!(eta > 0.0)) throw std::invalid_argument("the loop's largest force is too weak for its slope and period");
  return {
      .period = period, .amplitude = period * largest / std::numbers::pi, .spring = (1.0 + 1.0 / eta) * slope_at_rest};
}

}  // namespace afm::physics
