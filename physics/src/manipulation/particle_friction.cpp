// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/particle_friction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fixed_point.h"
#include "physics/adhesion_map.h"
#include "physics/contact_parameters.h"
#include "physics/jkr.h"
#include "physics/manipulation/particle_limits.h"
#include "physics/quantity_text.h"
#include "require_range.h"

namespace afm::physics {
namespace {

using std::numbers::pi;

constexpr double kLargestPush = 1e-3;  // force beyond the range of any lever, N
constexpr double kHeld = 1.0 - 1e-9;   // share of F_ad up to which a sphere stays on the sample

PushBalance jammed() {
  const Force infinite{std::numeric_limits<double>::infinity()};
  return {PushMode::Jams, infinite, infinite, infinite, infinite};
}

PushBalance slide(const ParticleSpecies& species, double sine, double cosine, double share) {
  const double radius = species.contact.tip_radius.si;
  const auto forces = [&](double normal) {
    // T and P depend on one another: P at the last T is enough, because the fixed point is that of both
    struct {
      double friction, sideways;
    } at{0.0, 0.0};
    for (int i = 0; i < 40; ++i) {
      const Force load(normal * sine + at.friction * cosine);
      at.sideways = share * sliding_threshold(species, load).si;
      const double rolls_at =
          species.rolling_distance.si > 0.0 ? share * rolling_moment(species, load).si / radius : HUGE_VAL;
      const double friction = std::max(0.0, at.sideways - rolls_at);
      if (friction == at.friction) break;
      at.friction = friction;
    }
    return at;
  };
  const double normal = least_fixed_point(
      [&](double n) {
        const auto at = forces(n);
        return (at.sideways + at.friction * sine) / cosine;
      },
      kLargestPush);
  if (!std::isfinite(normal)) return jammed();
  const auto at = forces(normal);
  return {PushMode::Slides, Force(normal), Force(at.friction), Force(normal * cosine - at.friction * sine),
          Force(normal * sine + at.friction * cosine)};
}

PushBalance roll(const ParticleSpecies& species, const TipGrip& grip, double sine, double cosine, double share) {
  const double mu = grip.coefficient, held = mu * grip.adhesion.si;
  const double arm = cosine - mu * (1.0 + sine);
  if (!(arm > 0.0)) return jammed();
  const double normal = least_fixed_point(
      [&](double n) {
        const double friction = mu * n + held;
        const Force load(n * sine + friction * cosine);
        const Force rolls_at = share * rolling_moment(species, load) / species.contact.tip_radius;
        return (rolls_at.si + held * (1.0 + sine)) / arm;
      },
      kLargestPush);
  if (!std::isfinite(normal)) return jammed();
  const double friction = mu * normal + held;
  return {PushMode::Rolls, Force(normal), Force(friction), Force(normal * cosine - friction * sine),
          Force(normal * sine + friction * cosine)};
}

}  // namespace

void validate(const ParticleSpecies& s) {
  require_range("radius", s.contact.tip_radius, kThinnestParticle, kThickestParticle, kLengthUnits);
  require_range("length", s.length, is_rod(s) ? s.contact.tip_radius : Length(0.0), Length(1e-4), kLengthUnits);
  if (is_rod(s) && s.law != ParticleLaw::Measured) {
    throw UnphysicalValue("law", "the friction of a rod is measured: its law cannot be another");
  }
  if (is_island(s) && (s.law != ParticleLaw::Measured || is_rod(s) || s.sticks || s.rolling_distance.si != 0.0)) {
    throw UnphysicalValue("island_radius", "an island has a measured friction, and neither rolls nor sticks to a tip");
  }
  require_range("island_radius", s.island_radius, is_island(s) ? kFlattestIsland * s.contact.tip_radius : Length(0.0),
                Length(1e-5), kLengthUnits);
  if (!turns_flat(s)) {
    require_range("reduced_modulus", s.contact.reduced_modulus, Pressure(1e5), Pressure(1e13), kPressureUnits);
    require_range("work_of_adhesion", s.contact.work_of_adhesion, SurfaceEnergy(1e-6), SurfaceEnergy(10.0),
                  kSurfaceEnergyUnits);
  }
  const bool shears = s.law == ParticleLaw::ContactArea || s.law == ParticleLaw::Both;
  require_range("shear_strength", s.shear_strength, Pressure(shears ? 1.0 : 0.0), Pressure(1e11), kPressureUnits);
  require_range("coefficient", s.coefficient, s.law == ParticleLaw::Amontons ? 1e-6 : 0.0, 10.0, kPlainNumber);
  require_range("measured_threshold", s.measured_threshold, Force(s.law == ParticleLaw::Measured ? 1e-15 : 0.0),
                Force(1e-4), kForceUnits);
  require_range("kinetic_ratio", s.kinetic_ratio, 1e-3, 1.0, kPlainNumber);
  require_range("ageing", s.ageing, Time(0.0), Time(1e6), kTimeUnits);
  require_range("rolling_distance", s.rolling_distance, Length(0.0), is_rod(s) ? Length(0.0) : s.contact.tip_radius,
                kLengthUnits);
  if (s.sticks && is_rod(s)) throw UnphysicalValue("sticks", "only spheres stick to a tip, and this is a rod");
  require_range("tip_adhesion", s.tip_adhesion, SurfaceEnergy(s.sticks ? 1e-6 : 0.0), SurfaceEnergy(10.0),
                kSurfaceEnergyUnits);
}

Force pull_off_force(const ParticleSpecies& species) noexcept { return -jkr_pull_off_load(species.contact); }

double tabor_parameter(const ParticleSpecies& species, Length atomic_distance) {
  ContactParameters contact{};
  contact.tip_radius = species.contact.tip_radius;
  contact.reduced_modulus = species.contact.reduced_modulus;
  contact.mean_surface_energy = species.contact.work_of_adhesion / 2.0;
  contact.atomic_distance = atomic_distance;
  return tabor_parameter(contact);
}

Force sliding_threshold(const ParticleSpecies& species, ParticleLaw law, Force load) {
  const auto sheared = [&] {
    const Length a = jkr_contact_radius(species.contact, load);
    return species.shear_strength * (pi * a * a);
  };
  switch (law) {
    case ParticleLaw::ContactArea:
      return sheared();
    case ParticleLaw::Amontons:
      return species.coefficient * (load + pull_off_force(species));
    case ParticleLaw::Both:
      return species.coefficient * load + sheared();
    case ParticleLaw::Measured:
      break;
  }
  return species.measured_threshold;
}

Force threshold_under_pull(const ParticleSpecies& species, Force pull) {
  const Force load = std::max(-pull, -(kHeld * pull_off_force(species)));
  return std::max(Force(0.0), sliding_threshold(species, load));
}

Torque rolling_moment(const ParticleSpecies& species, Force load) {
  const auto& [r, e, w] = species.contact;
  const Length a = jkr_contact_radius(species.contact, load);
  return species.rolling_distance * (a * sqrt(8.0 * pi * w * e * a));
}

double spinning_share(const ParticleSpecies& species, Force load) {
  return 2.0 / 3.0 * (jkr_contact_radius(species.contact, load) / species.contact.tip_radius);
}

PushBalance push_balance(const ParticleSpecies& species, const TipGrip& grip, double sine, double cosine,
                         double share) {
  const PushBalance slides = slide(species, sine, cosine, share);
  const bool held = slides.friction <= grip.coefficient * (slides.normal + grip.adhesion);
  if (species.rolling_distance.si <= 0.0 || (slides.mode == PushMode::Slides && held)) return slides;
  return roll(species, grip, sine, cosine, share);
}

}  // namespace afm::physics
