// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/prandtl_tomlinson.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace afm::physics {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double wave_number(const SineLattice& lattice) { return kTurn / lattice.period.si; }

double potential_of(const SineLattice& lattice, double tip_m, double support_m) {
  const double stretch_m = tip_m - support_m;
  return -0.5 * lattice.amplitude.si * std::cos(wave_number(lattice) * tip_m) +
         0.5 * lattice.spring.si * stretch_m * stretch_m;
}

// dV/dx.
double slope_of(const SineLattice& lattice, double tip_m, double support_m) {
  const double q = wave_number(lattice);
  return 0.5 * lattice.amplitude.si * q * std::sin(q * tip_m) + lattice.spring.si * (tip_m - support_m);
}

// Zero of dV/dx between two places at which it has opposite signs.
double rest_between(const SineLattice& lattice, double low_m, double high_m, double support_m) {
  const bool rising = slope_of(lattice, high_m, support_m) > 0.0;
  for (int i = 0; i < 200 && low_m < high_m; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    if (middle_m <= low_m || middle_m >= high_m) break;
    ((slope_of(lattice, middle_m, support_m) > 0.0) == rising ? high_m : low_m) = middle_m;
  }
  return 0.5 * (low_m + high_m);
}

// Place where the curvature of the potential vanishes: cos(q x) = -1/eta.
double tip_at_slip(const SineLattice& lattice) {
  return std::acos(-1.0 / slip_parameter(lattice)) / wave_number(lattice);
}

}  // namespace

double slip_parameter(const SineLattice& lattice) {
  const double q = wave_number(lattice);
  return 0.5 * lattice.amplitude.si * q * q / lattice.spring.si;
}

Force largest_lateral_force(const SineLattice& lattice) {
  return std::numbers::pi * lattice.amplitude / lattice.period;
}

Stiffness slope_at_rest(const SineLattice& lattice) {
  const double eta = slip_parameter(lattice);
  return eta / (1.0 + eta) * lattice.spring;
}

std::optional<SineSlip> first_slip(const SineLattice& lattice) {
  const double eta = slip_parameter(lattice);
  if (!(eta > 1.0)) return std::nullopt;
  const double a = lattice.period.si, k = lattice.spring.si;
  const double before = tip_at_slip(lattice);
  const double force = k / wave_number(lattice) * std::sqrt(eta * eta - 1.0);
  const double support = before + force / k;
  // in the next well the tip is between the place where its curvature begins, and where it would slip on
  const double after = rest_between(lattice, a - before, a + before, support);
  return SineSlip{.support = Length(support),
                  .tip_before = Length(before),
                  .tip_after = Length(after),
                  .force_before = Force(force),
                  .force_after = Force(k * (support - after)),
                  .lost = Energy(potential_of(lattice, before, support) - potential_of(lattice, after, support))};
}

Force mean_friction(const SineLattice& lattice) {
  const auto slip = first_slip(lattice);
  return slip ? slip->lost / lattice.period : Force();
}

Energy loop_energy(const SineLattice& lattice, Length stroke) { return 2.0 * mean_friction(lattice) * stroke; }

SlipBarrier barrier_before_slip(const SineLattice& lattice, Length before) {
  const double slip_m = tip_at_slip(lattice);
  const double support = first_slip(lattice).value().support.si - before.si;
  const double rest = rest_between(lattice, -slip_m, slip_m, support);
  const double top = rest_between(lattice, slip_m, lattice.period.si - slip_m, support);
  return {.height = Energy(potential_of(lattice, top, support) - potential_of(lattice, rest, support)),
          .force = Force(lattice.spring.si * (support - rest))};
}

SineLattice lattice_of_loop(Length period, Force largest, Stiffness slope_at_rest) {
  const double eta = kTurn * (largest / (slope_at_rest * period)) - 1.0;
  if (!(eta > 0.0)) throw std::invalid_argument("the loop's largest force is too weak for its slope and period");
  return {
      .period = period, .amplitude = period * largest / std::numbers::pi, .spring = (1.0 + 1.0 / eta) * slope_at_rest};
}

}  // namespace afm::physics
