// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/manipulation/particle_friction.h"
#include "physics/manipulation/tip_contact.h"
#include "physics/units.h"

// Figures that a user needs before a push: gentlest load of a scan, stiffness of the lever, accuracy of the aim. Any
// thread; never in a tick.
namespace afm::physics {

// Springs along the contact normal, in series (M8).
struct PushSprings {
  Stiffness lateral;  // k_l, lateral stiffness of the lever
  Stiffness normal;   // k_c, normal stiffness of the lever
  Stiffness contact;  // k_n, normal stiffness of the contact of tip and sphere
};

// 1/k_eff = 1/k_n + cos^2/k_l + sin^2/k_c, N = k_eff times the overlap.
Stiffness stiffness_along_normal(const PushSprings& springs, double sine, double cosine) noexcept;

// Stiffness k_eff cos^2 against a sideways motion.
Stiffness stiffness_sideways(const PushSprings& springs, double sine, double cosine) noexcept;

// F_0 cot(theta - atan(mu_t)) = f_s(F_0) (M9): with feedback on, a scan above this load pushes the sphere instead of
// climbing it. 0 if mu_t >= tan(theta), where no load is gentle.
Force gentle_load(const ParticleSpecies& species, const SphereCone& tip, double tip_friction);

// The load up to which a scan climbs a particle and moves none: gentle_load(), for a rod at its end, where it gives
// most easily. Where friction at the tip leaves no gentle load, that of a tip without friction.
Force climbing_load(const ParticleSpecies& species, const SphereCone& tip, double tip_friction);

// Feedback off, apex set on the sample without load, no friction at the tip: the smallest k_c with which the tip pushes
// the sphere before it rides over it, max over h of k_c h cot(phi(h)) - f_s(k_c h) = 0 (M10).
Stiffness softest_lever(const ParticleSpecies& species, const SphereCone& tip);

// The largest lateral force on a sphere before the tip rides over: (F_0 + k_c h_c) cot(theta) (M11), at the end of the
// flank. `preload` is F_0 on the sample.
Force largest_push(const SphereCone& tip, Length sphere_radius, Stiffness normal_spring, Force preload) noexcept;

// The largest offset of the centre from the tip's path, over rho, with which a push of `travel` does not lose the
// sphere: sin(alpha_0) = 1/cosh(travel/rho) (M12).
double largest_offset(double travel_over_rho) noexcept;

// Delay of a hand that steers by eye and touch, order of magnitude.
inline constexpr Time kSteeringDelay{0.25};

// The fastest hand that steers with the delay T can balance a sphere: rho/T (M14).
Velocity fastest_steering(Length rho, Time delay) noexcept;

}  // namespace afm::physics
