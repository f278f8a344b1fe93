// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "physics/manipulation/particle_friction.h"
#include "physics/manipulation/tip_contact.h"
#include "physics/units.h"

// Adhesion of tip and sphere (docs/manipulation.md): a contact that has formed pulls up to F_t, and tears there. Any
// thread; nothing allocates.
namespace afm::physics {

struct PushSetup;

// F_t = 3/2 pi W_t R_eff, on the flank or on the cap (M22).
Force tip_pull_off(const SphereCone& tip, const ParticleSpecies& species, bool on_flank) noexcept;

// Friction and adhesion between tip and sphere on the flank.
TipGrip flank_grip(const SphereCone& tip, const ParticleSpecies& species, double tip_friction) noexcept;

// The strongest pull of a tip on spheres that stick to it, 0 if they do not; with scatter, twice F_t, which one contact
// of 5000 exceeds.
Force strongest_pull(const SphereCone& tip, const ParticleSpecies& species) noexcept;

// True if a sphere on the flank of a tip that moves back follows it, F_t cos(theta) > f_s(-F_t sin(theta)) (M23);
// otherwise the contact tears.
bool follows_tip(const SphereCone& tip, const ParticleSpecies& species);

// The smallest W_t with which a tip that rises from the top lifts the sphere off the sample, W (R_t + R_p)/R_t (M24).
SurfaceEnergy lifting_adhesion(const SphereCone& tip, const ParticleSpecies& species) noexcept;

// True if the tip lifts the sphere off the sample, from the top or on its flank.
bool lifts(const SphereCone& tip, const ParticleSpecies& species) noexcept;

// True if the tip lifts the sphere off the sample or off any of its pads.
bool lifts_anywhere(const PushSetup& setup, const ParticleSpecies& species) noexcept;

// Energy that a lone contact on this normal loses when it tears, F_t^2/(2 k_eff) (M25).
Energy tear_energy(Force pull_off, Stiffness along_normal) noexcept;

// Uniform number between 0 and 1 for the contact `count` of a particle, the same on every machine.
double scatter_number(std::uint64_t seed, std::uint64_t particle, std::uint64_t count) noexcept;

// Factor of the contact's pull-off force: log-normal with a mean of 1 and a spread of 20 % (M26).
double pull_off_factor(std::uint64_t seed, std::uint64_t particle, std::uint64_t count) noexcept;

}  // namespace afm::physics
