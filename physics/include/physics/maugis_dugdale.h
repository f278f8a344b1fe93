// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/adhesive_contact.h"
#include "physics/units.h"

// The contact between DMT and JKR: an elastic sphere whose surfaces attract with a constant stress sigma0 in a ring
// around the contact, of inner radius a and outer radius c (Maugis 1992, after Dugdale). In Maugis' units: radii by
// (pi W R^2/K)^(1/3), loads by pi W R, indentations by (pi^2 W^2 R/K^2)^(1/3), with K = 4 E*/3. For any thread.
namespace afm::physics {

// One contact of Maugis' family. With m = c/a = 1/cos(theta) his equations are, for given lambda,
//
//   1 = (lambda a^2/2) [sqrt(m^2-1) + (m^2-2) acos(1/m)] + (4 lambda^2 a/3) [sqrt(m^2-1) acos(1/m) - m + 1]   (6.18)
//   P = a^3 - lambda a^2 [sqrt(m^2-1) + m^2 acos(1/m)]                                                        (6.16)
//   delta = a^2 - (4/3) lambda a sqrt(m^2-1)                                                                  (6.17)
//
// In theta and c the first is a quadratic in c, so no iteration is needed and both ends are regular: JKR at theta -> 0,
// a contact shrunk to a point within its cohesive zone at theta = pi/2. The family's parameter is s = ln sin(theta),
// from -infinity deep inside to 0 at the point. Beyond, the zone continues without a contact (Kim, McMeeking & Johnson
// 1998), as a disc of the radius c = c(0) exp(-s) that pulls with pi c^2 sigma0:
//
//   P = -(pi/2) lambda c^2,   delta = c^2/2 - (8/(3 pi)) lambda c - 2/(pi lambda)
//
// a and c decrease all the way; load and indentation are continuous.
struct MaugisPoint {
  double contact_radius;  // contact radius a; 0 for s >= 0
  double load;            // load P
  double indentation;     // indentation delta
  double dload_ds;
  double dindentation_ds;
};

// One point of the family for lambda > 0. The derivatives at s = 0 are those of the contact.
MaugisPoint maugis_point(double lambda, double s);

// The parameter s of three contacts: the least load, at which contact is lost at a given load; the least indentation,
// at which it is lost under fixed grips (above 0, in a zone without contact, for lambda below cbrt(9 pi/(16 (pi - 1)))
// = 0.938, where c = 8 lambda/(3 pi) solves (6.18) at the point); and the stable contact with `load`, at least that of
// the first. The last function throws std::invalid_argument for a smaller load.
double maugis_pull_off(double lambda);
double maugis_fixed_grips_end(double lambda);
double maugis_at_load(double lambda, double load);

// Maugis' units of a contact.
struct MaugisUnits {
  Length radius;
  Force load;
  Length indentation;
};
MaugisUnits maugis_units(const AdhesiveContact& contact) noexcept;

// sigma0 = 16 W/(9 sqrt3 z0), the peak of the traction of surfaces that attract by the 3-9 law.
Pressure cohesive_stress(SurfaceEnergy work_of_adhesion, Length atomic_distance) noexcept;

// lambda = 2 sigma0 (R/(pi W K^2))^(1/3).
double maugis_lambda(const AdhesiveContact& contact, Pressure cohesive_stress) noexcept;

}  // namespace afm::physics
