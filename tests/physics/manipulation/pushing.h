// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "physics/elasticity.h"
#include "physics/manipulation/pushed_particles.h"

namespace afm::physics::test {

inline double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

inline void expect_relative(double actual, double expected, double tolerance) {
  EXPECT_NEAR(actual, expected, tolerance * std::abs(expected));
}

// Gold of 25 nm radius on mica and polystyrene of 50 nm on silicon, as in the table of cases.
inline ParticleSpecies gold() {
  ParticleSpecies species;
  const Pressure modulus = reduced_modulus({Pressure(79e9), 0.44}, {Pressure(60e9), 0.25});
  species.contact = {Length(25e-9), modulus, SurfaceEnergy(0.1)};
  species.shear_strength = Pressure(10e6);
  species.rolling_distance = Length(0.3e-9);
  return species;
}

inline ParticleSpecies latex() {
  ParticleSpecies species;
  const Pressure modulus = reduced_modulus({Pressure(3.2e9), 0.34}, {Pressure(165e9), 0.22});
  species.contact = {Length(50e-9), modulus, SurfaceEnergy(0.08)};
  species.shear_strength = Pressure(12e6);
  return species;
}

// A sphere with the same threshold at any load.
inline ParticleSpecies constant(Force threshold, double kinetic_ratio = 1.0, Length radius = Length(25e-9)) {
  ParticleSpecies species = gold();
  species.contact.tip_radius = radius;
  species.law = ParticleLaw::Measured;
  species.measured_threshold = threshold;
  species.kinetic_ratio = kinetic_ratio;
  species.rolling_distance = Length(0.0);
  return species;
}

inline SphereCone flank_tip(Length radius, double half_angle_deg = 15.0) {
  return {radius, half_angle_deg * std::numbers::pi / 180.0};
}

// Travel over rho until a sphere at the offset is lost, alpha = 90 degrees: -ln tan(alpha_0/2) (M13).
inline double travel_until_lost(double offset_over_rho) {
  return -std::log(std::tan(0.5 * std::asin(offset_over_rho)));
}

inline LeverBase base_at(double x_m, double y_m = 0.0, double z_m = 0.0) {
  return {{Length(x_m), Length(y_m)}, Length(z_m)};
}

// Moves the base on a straight line at a speed, in ticks of a rate.
inline void drag(PushedParticles& particles, const LeverBase& to, double speed_m_per_s, double rate_hz) {
  const LeverBase from = particles.last().base;
  const double x = (to.position.x - from.position.x).si, y = (to.position.y - from.position.y).si;
  const double z = (to.z - from.z).si;
  const double way = std::sqrt(x * x + y * y + z * z);
  const int ticks = std::max(1, static_cast<int>(std::ceil(way / speed_m_per_s * rate_hz)));
  for (int i = 1; i <= ticks; ++i) {
    const double s = static_cast<double>(i) / ticks;
    particles.move_to(base_at(from.position.x.si + s * x, from.position.y.si + s * y, from.z.si + s * z),
                      Time(1.0 / rate_hz));
  }
}

}  // namespace afm::physics::test
