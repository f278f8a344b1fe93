// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace afm::physics {

// WaitForLift: no force until the tip has been lifted above Z_joc, because below it the tip might be attached or free.
// Free: not touching. Attached: on the surface, pressed or adhering. Session files and curves contain the numbers.
enum class Phase : std::uint32_t { WaitForLift = 0, Free = 1, Attached = 2 };

// A jump from one branch of the law to the other, or between the states of a tapping lever, or sideways from one well
// of a lattice to the next (physics/friction/lattice_tip.h); or what a tip does to a particle on the sample
// (physics/manipulation). Session files contain the numbers.
enum class EventKind : std::uint32_t {
  JumpToContact = 1,
  JumpOffContact = 2,
  Slip = 3,
  ParticleTouched = 4,
  ParticleGave = 5,        // a particle at rest began to move
  ParticleLost = 6,        // the tip went past a particle that it had pushed
  ParticleRiddenOver = 7,  // the tip climbed over a particle, because its lever is too soft
  PushTakenBack = 8,       // the particles are where they were before the newest push
  ParticlesPutBack = 9,    // all particles are where they were at the start
  ParticleDragged = 10,    // a particle at rest began to follow a tip that pulls it by adhesion
  ParticleTorn = 11,       // the contact by which the tip pulled a particle tore
  JumpToRepulsion = 12,    // a tapping lever fell from the attractive into the repulsive state
  JumpToAttraction = 13,   // a tapping lever fell back into the attractive state
  ParticleLifted = 14,     // the tip lifted a particle off the sample, which now hangs on it
  ParticleSetDown = 15,    // a particle on the tip came to lie on the sample
  LookedAgain = 16,        // a person ordered another scan of the particles near the tip, which begins
  SurfaceMarked = 17,      // a tip began to press a soft sample in
  TipStopped = 18,         // a tip cannot sink deeper: the load is more than the model of a soft sample bears
  HandTooFast = 19,        // the lever on a soft sample was raised, because the hand moves faster than it scratches
  InkFlows = 20,           // a tip with ink touched the sample
  LiquidTorn = 21,         // it came off, and the liquid between tip and sample tore
  ParticleSwept = 22,      // a scan that presses too hard to climb a particle began to push it
};

// Name in reports and replays.
constexpr const char* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::JumpToContact:
      return "jump-to-contact";
    case EventKind::JumpOffContact:
      return "jump-off-contact";
    case EventKind::Slip:
      return "slip";
    case EventKind::ParticleTouched:
      return "particle-touched";
    case EventKind::ParticleGave:
      return "particle-gave";
    case EventKind::ParticleLost:
      return "particle-lost";
    case EventKind::ParticleRiddenOver:
      return "particle-ridden-over";
    case EventKind::PushTakenBack:
      return "push-taken-back";
    case EventKind::ParticlesPutBack:
      return "particles-put-back";
    case EventKind::ParticleDragged:
      return "particle-dragged";
    case EventKind::ParticleTorn:
      return "particle-torn";
    case EventKind::JumpToRepulsion:
      return "jump-to-repulsion";
    case EventKind::JumpToAttraction:
      return "jump-to-attraction";
    case EventKind::ParticleLifted:
      return "particle-lifted";
    case EventKind::ParticleSetDown:
      return "particle-set-down";
    case EventKind::LookedAgain:
      return "looked-again";
    case EventKind::SurfaceMarked:
      return "surface-marked";
    case EventKind::TipStopped:
      return "tip-stopped";
    case EventKind::HandTooFast:
      return "hand-too-fast";
    case EventKind::InkFlows:
      return "ink-flows";
    case EventKind::LiquidTorn:
      return "liquid-torn";
    case EventKind::ParticleSwept:
      return "particle-swept";
  }
  return "unknown";
}

// True for a jump of the law, whose forces are normal. Those of other events are lateral, except: for a lifted particle
// the pull-off from the sample, for particles that were put back or are looked at 0, for a soft sample or ink the load,
// for a liquid that tore its pull, for a tapping lever the mean over a swing.
constexpr bool is_jump(EventKind kind) { return kind == EventKind::JumpToContact || kind == EventKind::JumpOffContact; }

// Both ends of a cycle: a jump, or a change of the state of a tapping lever.
constexpr bool begins_cycle(EventKind kind) {
  return kind == EventKind::JumpToContact || kind == EventKind::JumpToRepulsion;
}
constexpr bool ends_cycle(EventKind kind) {
  return kind == EventKind::JumpOffContact || kind == EventKind::JumpToAttraction;
}

}  // namespace afm::physics
