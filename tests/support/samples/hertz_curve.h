// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "curves/recorded_curve.h"

namespace afm::test {

// Most frequent measurement of nanite's users: a soft gel under a sphere, without adhesion.
inline constexpr double kHertzModulusPa = 3000.0, kHertzPoisson = 0.5, kHertzRadiusM = 5e-6;
inline constexpr double kHertzSpringConstant = 0.05;

// Force of Hertz's law: F = 4/3 E/(1 - nu^2) sqrt(R) delta^1.5 (Hertz 1882).
inline double hertz_force_n(double modulus_pa, double indentation_m) {
  if (indentation_m <= 0.0) return 0.0;
  return 4.0 / 3.0 * modulus_pa / (1.0 - kHertzPoisson * kHertzPoisson) * std::sqrt(kHertzRadiusM) *
         std::pow(indentation_m, 1.5);
}

// The tip's indentation for the base at z: z = -indentation - F(indentation)/k, by Newton's method.
inline double hertz_indentation_m(double z_m) {
  double indentation = z_m < 0.0 ? -z_m : 0.0;
  for (int i = 0; i < 60 && z_m < 0.0; ++i) {
    const double force = hertz_force_n(kHertzModulusPa, indentation);
    const double slope = 1.0 + 1.5 * force / indentation / kHertzSpringConstant;
    indentation -= (indentation + force / kHertzSpringConstant + z_m) / slope;
  }
  return indentation;
}

// Curve from 2 um above the gel to 1.5 um below and back, evenly spaced like an instrument's.
inline curves::RecordedCurve hertz_curve(std::size_t points_a_branch = 2000) {
  curves::RecordedCurve curve;
  for (const auto branch : {physics::Branch::Approach, physics::Branch::Retract}) {
    for (std::size_t i = 0; i < points_a_branch; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(points_a_branch - 1);
      const double z = branch == physics::Branch::Approach ? 2e-6 - 3.5e-6 * share : -1.5e-6 + 3.5e-6 * share;
      curve.points.push_back(
          {physics::Length(z), physics::Force(hertz_force_n(kHertzModulusPa, hertz_indentation_m(z))), branch});
    }
  }
  curve.metadata.spring_constant = physics::Stiffness(kHertzSpringConstant);
  curve.metadata.software = "TouchAFM";
  return curve;
}

// Fit by a third party to the file: the tip's position is height + F/k; modulus and contact point by least squares
// over all of the approach. Linear in the modulus, the contact point by golden-section search.
inline double fitted_modulus_pa(const curves::RecordedCurve& curve) {
  const double k = curve.metadata.spring_constant->si;
  double modulus = 0.0;
  const auto misfit = [&](double contact_m) {
    double fm = 0.0, mm = 0.0, ff = 0.0;
    for (const auto& point : curve.points) {
      if (point.branch != physics::Branch::Approach) continue;
      const double model = hertz_force_n(1.0, contact_m - (point.z.si + point.force.si / k));
      fm += point.force.si * model;
      mm += model * model;
      ff += point.force.si * point.force.si;
    }
    modulus = fm / mm;
    return ff - modulus * fm;
  };
  double low = -200e-9, high = 200e-9;
  for (int i = 0; i < 80; ++i) {
    const double a = high - 0.618033988749895 * (high - low), b = low + 0.618033988749895 * (high - low);
    if (misfit(a) < misfit(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  misfit(0.5 * (low + high));
  return modulus;
}

}  // namespace afm::test
