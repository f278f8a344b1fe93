// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "physics/contact.h"
#include "physics/interaction.h"
#include "physics/units.h"

namespace afm::physics {

// WaitForLift: no force is given until the tip has been lifted above Z_joc, because below it nobody knows whether it
// sticks. Free: not touching. Attached: on the surface, pressed or adhering.
enum class Phase { WaitForLift, Free, Attached };

enum class EventKind { JumpToContact, JumpOffContact };

// A jump, where the path crossed its threshold.
struct ModelEvent {
  EventKind kind = EventKind::JumpToContact;
  Length z;
  Force force_before;     // signed, as in physics/contact.h
  Force force_after;      // signed
  double fraction = 0.0;  // of the step's interval, in [0, 1]
};

// What the tip and the lever do at one Z; frames and signs as in physics/contact.h. `events` holds `event_count` jumps
// in the order in which they happened within the step.
struct TipResponse {
  Force force;  // on the tip, by the sample
  Length tip_height;
  Length cantilever_deflection;
  Length sample_deformation;
  Phase phase = Phase::WaitForLift;
  std::array<ModelEvent, 2> events{};
  std::uint32_t event_count = 0;
};

// The paper's approach-retract law as a two-state latch: Free until Z <= Z_jtc, Attached until Z >= Z_joc. The
// direction of motion is never consulted.
//
// - F = 0 while free, F = -k' Z while attached: pulled towards the sample for Z > 0, pushed away for Z < 0.
// - The thresholds are looked for on the whole path between two steps, taken as straight, and the jump's place and
//   forces are those of the threshold itself: they do not depend on where the samples fell.
// - No jump happens inside (Z_jtc, Z_joc); a wiggle there costs no work, and no closed path gives work.
// - A straight path holds at most one jump, since Z_jtc < Z_joc.
// - A Z that is not finite gives zero force and the wait state.
//
// step() and wait_for_lift() do not allocate, lock or throw: they are for one servo thread.
class ApproachRetractModel {
 public:
  // Starts in WaitForLift. Throws std::invalid_argument as validate() does, and if Z_joc <= Z_jtc: an adhesion too weak
  // to hold what the van der Waals force has pulled in leaves this law no loop.
  explicit ApproachRetractModel(const Interaction& interaction);

  // The response at Z after the straight path from the Z of the step before, if there was one since the tip was lifted.
  TipResponse step(Length z) noexcept;

  // After a start, a change of material or a dropout: zero force until Z > Z_joc.
  void wait_for_lift() noexcept { phase_ = Phase::WaitForLift; }

  Phase phase() const noexcept { return phase_; }
  const Interaction& interaction() const noexcept { return interaction_; }
  const ApproachRetractEvents& events() const noexcept { return events_; }

 private:
  // F(Z) = force_at_zero + slope Z on one side of the latch.
  struct Branch {
    Force force_at_zero;
    Stiffness slope;
    Force force(Length z) const noexcept { return force_at_zero + slope * z; }
  };

  ModelEvent jump(EventKind kind, Length threshold, Length z) const noexcept;

  Interaction interaction_;
  ApproachRetractEvents events_;
  Branch free_;
  Branch attached_;
  Phase phase_ = Phase::WaitForLift;
  Length previous_z_;  // of the step before; meaningless in WaitForLift
};

}  // namespace afm::physics
