// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "physics/curve_point.h"

// Curves of a sphere of 5 um on a gel under a lever of 0.05 N/m, with 5 pN of noise.
namespace afm::test {

inline constexpr double kSpring = 0.05, kRadiusM = 5e-6, kPoisson = 0.5, kNoiseN = 5e-12, kContactM = 12.3e-6;

// Force of Hertz's law (1882).
inline double force_n(double modulus_pa, double indentation_m) {
  return 4.0 / 3.0 * modulus_pa / (1.0 - kPoisson * kPoisson) * std::sqrt(kRadiusM) * std::pow(indentation_m, 1.5);
}

// Force with the lever's base at `below_m` below the contact point, by Newton's method.
inline double pushed_n(double modulus_pa, double below_m) {
  if (below_m <= 0.0) return 0.0;
  double indentation_m = below_m;
  for (int i = 0; i < 60; ++i) {
    const double force = force_n(modulus_pa, indentation_m);
    indentation_m -= (indentation_m + force / kSpring - below_m) / (1.0 + 1.5 * force / indentation_m / kSpring);
  }
  return force_n(modulus_pa, indentation_m);
}

struct Gel {
  double modulus_pa = 1e3;
  double depth_m = 1e-6;    // depth of the lever's base at the deepest point
  double outside_m = 2e-6;  // height of the beginning; negative: the approach begins below the contact point
  double tilt = 0.0;        // slope of the baseline, N/m
  double wave_n = 0.0;      // amplitude of the baseline's waves
  double period_m = 4e-7;
  double phase = 0.0;
  int points = 2000;
};

inline std::vector<physics::CurvePoint> gel_cycle(const Gel& gel, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, kNoiseN);
  std::vector<physics::CurvePoint> points;
  for (const physics::Branch branch : {physics::Branch::Approach, physics::Branch::Retract}) {
    for (int i = 0; i < gel.points; ++i) {
      const double share =
          static_cast<double>(branch == physics::Branch::Approach ? i : gel.points - 1 - i) / (gel.points - 1);
      const double z = gel.outside_m - (gel.outside_m + gel.depth_m) * share;
      const double wave = gel.wave_n * std::sin(2.0 * std::numbers::pi * z / gel.period_m + gel.phase);
      points.push_back({physics::Length(kContactM + z),
                        physics::Force(pushed_n(gel.modulus_pa, -z) + 1e-9 + gel.tilt * z + wave + noise(random)),
                        branch});
    }
  }
  return points;
}

}  // namespace afm::test
