// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/units.h"

// Spring constants and resonances of cantilevers from their geometry. All functions require valid levers. Any thread.
// The validate() functions throw UnphysicalValue with the member's name.
namespace afm::physics {

struct RectangularLever {
  Length length;
  Length width;
  Length thickness;
  Pressure young_modulus;
  Density density;
};

// Two arms that meet at the tip.
struct VShapedLever {
  Length length;      // distance from the base to the tip
  Length base_width;  // b, distance of the arms' outer edges at the base
  Length arm_width;   // d, width of each arm, parallel to the base
  Length thickness;
  Pressure young_modulus;
};

// Lengths 10 nm to 10 mm, E 1 MPa to 10 TPa, density 1 to 30000 kg/m^3; the arms of a V narrower than half its base.
void validate(const RectangularLever& lever);
void validate(const VShapedLever& lever);

// k = E w t^3/(4 L^3) (Euler-Bernoulli, load at the end).
Stiffness spring_constant(const RectangularLever& lever);

// The parallel-beam approximation of Sader 1995: k = E t^3 d/(2 L^3) cos(th) [1 + (4 d^3/b^3)(3 cos(th) - 2)]^-1 with
// tan(th) = b/(2 L). Agrees within some per cent with a bending and twisting frame for th from 15 to 35 degrees.
Stiffness spring_constant(const VShapedLever& lever);

// f_i = alpha_i^2/(2 pi) sqrt(E I/(rho A L^4)) in vacuum; alpha_i of physics/flexural_modes.h.
Frequency vacuum_resonance(const RectangularLever& lever, int mode = 1);

// Stiffness of a lever of spring constant k against a force along the sample's normal if the lever is mounted at an
// angle to the sample: k/cos^2(tilt) (Heim, Kappl & Butt 2004; without the tip's length and friction). Tilt below 90
// degrees.
Stiffness tilted_spring_constant(Stiffness spring_constant, double tilt_rad);

// Torsional stiffness against a lateral force at the apex of a tip of height h: k_lat = G w t^3/(3 L h^2) with G = E/(2
// (1 + nu)), for t well below w.
Stiffness lateral_stiffness(const RectangularLever& lever, double poisson_ratio, Length tip_height);

// Torsional stiffness from a known spring constant k: k 2/(3 (1 + nu)) (L/h)^2.
Stiffness lateral_stiffness(Stiffness spring_constant, double poisson_ratio, Length length, Length tip_height);

}  // namespace afm::physics
