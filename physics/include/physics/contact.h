// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/contact_parameters.h"
#include "physics/units.h"

// Closed forms of Liu & Peng, section 3.2, with their equation numbers. All are evaluated with a finite alpha, never
// assumed to be 1. All require valid interactions (physics/contact_parameters.h). Any thread.
//
// Signs and frames, for the whole program:
//   +z is the outward normal of the sample, z = 0 its undeformed surface.
//   Force on the tip is positive away from the sample: repulsion > 0, attraction < 0.
//   Z = D + delta_c + delta_s (3.5): Z is the height that the apex would have on an unbent lever, D the gap between the
//   apex and the deformed surface, delta_c > 0 a lever bent towards the sample, delta_s > 0 a surface drawn out towards
//   the tip. So the apex is at z = Z - delta_c = D + delta_s, and at rest F = -k_c delta_c = -k_s delta_s.
// The paper prints its events without signs, and so are the values below: magnitudes, all >= 0.
namespace afm::physics {

// alpha = 1 + k_c/k_s (3.7); 1 for a rigid sample.
double alpha(const ContactParameters& contact);

// k' = k_c k_s/(k_c + k_s) (3.1): the slope of the contact line, lever and sample in series.
Stiffness effective_stiffness(const ContactParameters& contact);

// D_attr = cbrt(alpha A_H R/(3 k_c)) (3.8): the gap at which the tip jumps to contact.
Length jump_to_contact_gap(const ContactParameters& contact);

// (delta_c)_attr = 1/2 cbrt(A_H R/(3 alpha^2 k_c)) (3.9): the lever's deflection just before that jump.
Length jump_to_contact_deflection(const ContactParameters& contact);

// Z_jtc = D_attr + alpha (delta_c)_attr (3.6), from Hao, Baro & Saenz 1991: the fold of Z(D) under van der Waals
// attraction. It is 3/2 D_attr for every alpha.
Length jump_to_contact_z(const ContactParameters& contact);

// W_ad = 2 sqrt(gamma_s gamma_t) (3.3).
SurfaceEnergy work_of_adhesion(const ContactParameters& contact);

// F_ad = 2 pi R W_ad (3.2), (3.4), from Derjaguin, Muller & Toporov 1975: the pull-off force.
Force adhesion_force(const ContactParameters& contact);

// All events of one cycle, as magnitudes.
struct ApproachRetractEvents {
  double alpha = 1.0;
  Stiffness effective_stiffness;  // k', lever and sample in series
  Length d_attr;                  // gap at the jump to contact
  Length delta_c_attr;            // deflection of the lever just before the jump to contact
  Length delta_s_attr;            // deformation of the sample just before the jump to contact, (k_c/k_s) (delta_c)_attr
  Length z_jtc;                   // Z at the jump to contact
  Force f_fold;  // attraction just before the jump, k_c (delta_c)_attr: a third of F_attr when alpha = 1
  Force f_attr;  // k' Z_jtc (3.10): the lever's pull just after the jump, with the tip on the surface
  SurfaceEnergy work_of_adhesion;
  Force f_ad;          // pull-off force
  Length z_joc;        // Z at the jump off contact, F_ad/k'; the paper prints no equation for it
  Energy loop_energy;  // k' (Z_joc^2 - Z_jtc^2)/2: dissipated by one cycle of the latch; negative if Z_joc < Z_jtc
};

// Throws std::invalid_argument as validate() does.
ApproachRetractEvents approach_retract_events(const ContactParameters& contact);

}  // namespace afm::physics
