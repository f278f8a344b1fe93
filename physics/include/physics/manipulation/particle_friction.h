// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "physics/adhesive_contact.h"
#include "physics/manipulation/particle_terms.h"
#include "physics/rows_of_enum.h"
#include "physics/units.h"

// Force at which a sphere on the sample starts to move, and whether it then slides or rolls (docs/manipulation.md). The
// contact of sphere and sample is that of JKR. Any thread; nothing allocates unless it throws.
namespace afm::physics {

// One kind of sphere, rod or flat island on one sample. A parameter that the law does not use may be zero; rods and
// islands need no modulus and no work of adhesion, and their law is ParticleLaw::Measured.
struct ParticleSpecies {
  AdhesiveContact contact;  // contact with the sample; its tip_radius is R_p: radius of sphere, rod or island's rim
  ParticleLaw law = ParticleLaw::ContactArea;
  Pressure shear_strength;         // tau, shear strength of the contact
  double coefficient = 0.0;        // mu, coefficient of friction
  Force measured_threshold;        // f_s of ParticleLaw::Measured; for a rod, the force that moves it sideways
  double kinetic_ratio = 0.5;      // r_k = f_k/f_s, ratio of kinetic and static friction, above 0 and at most 1
  Time ageing;                     // t_a, time constant of ageing; 0: a resting sphere has f_s at once
  Length rolling_distance;         // xi, distance of rolling friction; 0: the sphere slides and never rolls
  SurfaceEnergy tip_adhesion;      // W_t, work of adhesion between sphere and tip
  Length length;                   // length of a rod's axis, which rests on the sample; 0: a sphere
  bool sticks = false;             // true: the tip holds a sphere after touching it (tip_hold.h); needs tip_adhesion
  std::uint16_t scatter_seed = 0;  // seed of the scatter of pull-offs; 0: none
  Length island_radius;            // R of a flat island with a height of 2 R_p and a round rim; 0: no island
};

inline bool is_rod(const ParticleSpecies& species) noexcept { return species.length.si > 0.0; }
inline bool is_island(const ParticleSpecies& species) noexcept { return species.island_radius.si > 0.0; }

// A rod or an island: pushed off centre it turns about the vertical, and it never rolls.
inline bool turns_flat(const ParticleSpecies& species) noexcept { return is_rod(species) || is_island(species); }

// Radius seen from above: radius of a sphere, half width of a rod, radius of an island.
inline Length outer_radius(const ParticleSpecies& species) noexcept {
  return is_island(species) ? species.island_radius : species.contact.tip_radius;
}

// Radius of an island without its rim; 0 for other particles.
inline Length core_radius(const ParticleSpecies& species) noexcept {
  return is_island(species) ? species.island_radius - species.contact.tip_radius : Length(0.0);
}

// Throws UnphysicalValue with the name of the member unless every value is within its range, and the law has the
// parameters that it needs.
void validate(const ParticleSpecies& species);

// Pull-off of sphere and sample, F_ad = 3/2 pi W R.
Force pull_off_force(const ParticleSpecies& species) noexcept;

// Tabor parameter of the contact: JKR above 5, DMT below 0.1 (physics/adhesion_map.h).
double tabor_parameter(const ParticleSpecies& species, Length atomic_distance);

// f_s at the load P >= 0 by a law; P excludes adhesion.
Force sliding_threshold(const ParticleSpecies& species, ParticleLaw law, Force load);
inline Force sliding_threshold(const ParticleSpecies& species, Force load) {
  return sliding_threshold(species, species.law, load);
}

// Threshold f_s of a sphere that is pulled up; it loses its hold on the sample at F_ad.
Force threshold_under_pull(const ParticleSpecies& species, Force pull);

// M(P) = xi sqrt(8 pi W E* a^3), 6 pi W R xi at P = 0 (Dominik & Tielens 1995; M5).
Torque rolling_moment(const ParticleSpecies& species, Force load);

// Moment that spins the sphere about the vertical, 2/3 f a, over f R: a few percent, so that a sphere spins under an
// off-centre tip and is pushed as if without friction there.
double spinning_share(const ParticleSpecies& species, Force load);

enum class PushMode : std::uint32_t { Slides = 0, Rolls = 1, Jams = 2 };

struct PushModeText {
  PushMode mode;
  std::string_view word;
};
inline constexpr std::array kPushModes{PushModeText{PushMode::Slides, "slides"}, PushModeText{PushMode::Rolls, "rolls"},
                                       PushModeText{PushMode::Jams, "jams"}};
static_assert(has_row_for_each(kPushModes, &PushModeText::mode));

// Friction between tip and sphere: holds up to mu_t (N + F_t).
struct TipGrip {
  double coefficient = 0.0;  // mu_t, coefficient of friction of tip and sphere
  Force adhesion;            // F_t = 3/2 pi W_t R_eff, pull-off force of tip and sphere
};

// Forces at which a sphere yields to a tip whose normal points down by phi. All magnitudes.
struct PushBalance {
  PushMode mode = PushMode::Slides;
  Force normal;    // N, normal force between tip and sphere
  Force friction;  // T, friction at the tip, upwards on the tip's side of the sphere
  Force lateral;   // force on the lever against the push: N cos(phi) - T sin(phi)
  Force lift;      // upward force on the lever: N sin(phi) + T cos(phi), equal to the load P
};

// Balance of forces and moments (M6):
//
//   slides:  N cos - T sin = f_s(P),  T = max(0, f_s - M/R_p)  if T <= mu_t (N + F_t)
//   rolls:   T = mu_t (N + F_t),      N cos - T sin = M/R_p + T  otherwise
//
// Jams, with infinite forces, where no force suffices. `share` multiplies f_s and M: the kinetic ratio for a moving
// sphere, 1 for one at rest.
PushBalance push_balance(const ParticleSpecies& species, const TipGrip& grip, double sine, double cosine,
                         double share = 1.0);

}  // namespace afm::physics
