// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.h"
#include "haptics/device.h"
#include "scene/shared/particle_blocks.h"

namespace afm::physics {
struct PushSetup;
struct PushSprings;
}  // namespace afm::physics

namespace afm::haptics {

// Scale on which a hand pushes particles, the same along the sample and upwards.
//
// The median particle has SharedPusher::diameter_in_hand_m, or less, so that all of them lie within kFieldShare of the
// workspace. A lever stiffer than kMaxStiffnessNPerM is felt softer, and the figures give the factor. The particle
// gives at threshold_on_hand_n, or less, so that the lever bends by at most kMostBend of the distance of tip and
// particle before it gives: a force F at the distance r pushes a tip aside like a spring of -F/r, and bent further,
// lever and grip, each of some 200 N/m, let it slip round the particle. At a flat island it bends so little that the
// tip climbs at most as much of the rim.
//
// On a soft sample the tip, twice its radius, takes the place of the median particle, and threshold_on_hand_n, or
// kSoftShare of the strongest force, is the load that presses a groove as wide as the radius.
//
// With ink the dot of a second takes that place, and that force is the pull at which the liquid tears.
struct ParticleScale {
  static constexpr double kMaxStiffnessNPerM = 200.0;
  static constexpr double kFieldShare = 0.6;
  static constexpr double kMostBend = 1.0 / 3.0;
  static constexpr double kSoftShare = 0.5;

  double hand_m_per_m = 0;  // metres of the hand per metre of the nanoworld; 0: there are no particles
  double hand_n_per_n = 0;  // newtons on the hand per newton of a push
  double clear_z_m = 0;     // height from which a tip touches no particle; a ridge may be higher
  double softened_sideways = 1;
  double softened_upwards = 1;
};

// Stiffness of the lever in a hand at this device, at most; the sample's law has the rest of what it can render.
double particle_stiffness_n_per_m(const DeviceSpec& device);

// Scale for these particles, valid ones (scene::validate), for a soft sample or ink, on a device; without, the default.
// Fails if no force moves the median particle, or if the force on the hand would be too faint.
core::Result<ParticleScale> particle_scale(const scene::SharedParticles& particles, const DeviceSpec& device);

// Scale of a soft sample; otherwise as particle_scale().
core::Result<ParticleScale> soft_scale(const scene::SharedParticles& particles, const DeviceSpec& device);

// Scale of ink; otherwise as particle_scale().
core::Result<ParticleScale> ink_scale(const scene::SharedParticles& particles, const DeviceSpec& device);

// Springs of the lever as felt on that scale.
physics::PushSprings felt_springs(const scene::SharedPusher& pusher, const ParticleScale& scale);

// Physics of these particles with the springs as felt on that scale.
physics::PushSetup felt_setup(const scene::SharedParticles& particles, const ParticleScale& scale);

}  // namespace afm::haptics
