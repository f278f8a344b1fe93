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
  ParticleGave = 5,        // start of the motion of a particle at rest
  ParticleLost = 6,        // particle passed by the tip that had pushed it
  ParticleRiddenOver = 7,  // particle climbed by the tip, because its lever is too soft
  PushTakenBack = 8,       // newest push undone: every particle is back where it was before it
  ParticlesPutBack = 9,    // all particles back where they were at the start
  ParticleDragged = 10,    // start of a particle's motion behind a tip that pulls it by adhesion
  ParticleTorn = 11,       // contact torn by which the tip pulled a particle
  JumpToRepulsion = 12,    // fall of a tapping lever from the attractive into the repulsive state
  JumpToAttraction = 13,   // fall of a tapping lever back into the attractive state
  ParticleLifted = 14,     // particle lifted off the sample, which now hangs on the tip
  ParticleSetDown = 15,    // arrival of a carried particle on the sample
  LookedAgain = 16,        // start of another scan of the particles near the tip, ordered by a person
  SurfaceMarked = 17,      // start of an indentation of a soft sample by a tip
  TipStopped = 18,         // tip at its lowest height: the load exceeds the model of a soft sample
  HandTooFast = 19,        // lever raised from a soft sample, because the hand moves faster than it scratches
  InkFlows = 20,           // touch-down of a tip with ink
  LiquidTorn = 21,         // tear of the liquid between tip and sample, as the tip comes off
  ParticleSwept = 22,      // start of a particle's motion under a scan that presses too hard to climb it
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
