// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/contact_parameters.h"
#include "physics/law.h"
#include "physics/units.h"

namespace afm::physics {

// Van der Waals attraction of a sphere of radius R to a half-space at the gap D > 0, with the Hamaker constant A of the
// two across the medium. Any thread; does not allocate.
//
// - Derjaguin's approximation, for D << R: U = -A R/(6 D), F = -A R/(6 D^2) (Derjaguin 1934; Israelachvili,
//   Intermolecular and Surface Forces, ch. 13).
// - The exact sum over the sphere: U = -(A/6) [R/D + R/(D + 2R) + ln(D/(D + 2R))], F = -2 A R^3/(3 D^2 (D + 2R)^2)
//   (Hamaker 1937). It is Derjaguin's divided by (1 + D/2R)^2, so always weaker.
// - Retardation divides the potential by 1 + 14 D/lambda, with lambda near 100 nm (Gregory 1981, for the energy of
//   sphere and plate, D << R). The force is the derivative of that potential, Derjaguin's times (1 + 28 D/lambda)/(1 +
//   14 D/lambda)^2: 5 % less at 2 nm, 17 % at 5 nm, 1/D^3 far away.
//
// U < 0, F < 0, dF/dD > 0 for every gap; all three tend to zero; F = -dU/dD.
class VanDerWaals {
 public:
  VanDerWaals(Energy hamaker, Length tip_radius, const LawOptions& options = {});

  Energy potential(Length gap) const noexcept;  // potential U, zero far away
  Force force(Length gap) const noexcept;
  Stiffness gradient(Length gap) const noexcept;  // derivative of the force, dF/dD

  // The unique gap at which the force is `attraction` < 0.
  Length gap_at(Force attraction) const noexcept;

 private:
  // values without retardation
  double bare_potential(double gap) const noexcept;
  double bare_force(double gap) const noexcept;
  double bare_gradient(double gap) const noexcept;

  double hamaker_;
  double radius_;
  bool exact_sphere_;
  double retardation_per_metre_;  // 14/lambda, 0 without retardation
};

// a0, the gap of two bodies in contact at which van der Waals attraction equals adhesion: F(a0) = -F_ad, where F_ad = 2
// pi R W_ad; sqrt(A R/(6 F_ad)) in Derjaguin's approximation. For the paper's pairs of A_H and F_ad it is 0.32 to 0.38
// nm.
Length contact_gap(const ContactParameters& contact, const LawOptions& options = {});

}  // namespace afm::physics
