// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/friction.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <string>

#include "physics/adhesive_contact.h"
#include "physics/contact_parameters.h"
#include "physics/hertz.h"
#include "physics/jkr.h"
#include "physics/maugis_dugdale.h"
#include "require_range.h"

namespace afm::physics {

namespace {

Length maugis_contact_radius(const ContactParameters& contact, const AdhesiveContact& adhesive, Force force) {
  const MaugisUnits units = maugis_units(adhesive);
  const double lambda = maugis_lambda(adhesive, cohesive_stress(adhesive.work_of_adhesion, contact.atomic_distance));
  const double load = force / units.load;
  const double least = maugis_point(lambda, maugis_pull_off(lambda)).load;
  if (load <= least) return maugis_point(lambda, maugis_pull_off(lambda)).contact_radius * units.radius;
  return maugis_point(lambda, maugis_at_load(lambda, load)).contact_radius * units.radius;
}

Length contact_radius_of(Law law, const ContactParameters& contact, Force force) {
  const AdhesiveContact adhesive = adhesive_contact(contact);
  switch (law) {
    case Law::Hertz:
      return hertz_contact_radius(adhesive, std::max(Force(), force));
    case Law::Dmt:
      return dmt_contact_radius(adhesive, std::max(-dmt_adhesion(adhesive), force));
    case Law::Jkr:
      return jkr_contact_radius(adhesive, std::max(jkr_pull_off_load(adhesive), force));
    case Law::MaugisDugdale:
      return maugis_contact_radius(contact, adhesive, force);
    default:
      throw std::invalid_argument("the law " + std::string(name_of(law)) +
                                  " has no contact area; choose hertz, dmt, jkr or maugis");
  }
}

}  // namespace

std::optional<LatticeKind> lattice_kind_of(std::string_view word) {
  for (const LatticeKindText& row : kLatticeKinds) {
    if (row.word == word) return row.kind;
  }
  return std::nullopt;
}

void validate(const FrictionParameters& friction) {
  if (friction.law == FrictionLaw::None) return;
  require_range("lateral_stiffness", friction.lateral_stiffness, kSmallestLateralStiffness, kLargestLateralStiffness,
                kStiffnessUnits);
  if (friction.law == FrictionLaw::Amontons &&
      !(friction.coefficient > 0.0 && friction.coefficient <= kLargestFrictionCoefficient)) {
    throw UnphysicalValue("friction_coefficient", "friction coefficient " + std::to_string(friction.coefficient) +
                                                      " is not above 0 and at most 10");
  }
  if (friction.law == FrictionLaw::ContactArea) {
    require_range("shear_strength", friction.shear_strength, Pressure(1.0), kLargestShearStrength, kPressureUnits);
  }
  if (friction.law == FrictionLaw::Lattice) {
    require_range("lattice_period", friction.period, kSmallestPeriod, kLargestPeriod, kLengthUnits);
    require_range("lattice_corrugation", friction.corrugation, Length(1e-15), kLargestCorrugation, kLengthUnits);
  }
}

Area contact_area(Law law, const ContactParameters& contact, Force force) {
  const Length radius = contact_radius_of(law, contact, force);
  return std::numbers::pi * radius * radius;
}

Stiffness tangential_contact_stiffness(Pressure reduced_shear_modulus, Length contact_radius) {
  return 8.0 * reduced_shear_modulus * contact_radius;
}

Pressure reduced_shear_modulus(Pressure tip_shear_modulus, double tip_poisson_ratio, Pressure sample_shear_modulus,
                               double sample_poisson_ratio) {
  return Pressure(1.0 / ((2.0 - tip_poisson_ratio) / tip_shear_modulus.si +
                         (2.0 - sample_poisson_ratio) / sample_shear_modulus.si));
}

}  // namespace afm::physics
