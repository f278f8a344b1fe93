// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "physics/contact_parameters.h"
#include "physics/contact_phase.h"
#include "physics/law_tables.h"
#include "physics/units.h"

namespace afm::physics {

// A jump, where the path crossed its threshold.
struct ModelEvent {
  EventKind kind = EventKind::JumpToContact;
  Length z;
  Force force_before;     // signed, as in physics/contact.h
  Force force_after;      // signed
  double fraction = 0.0;  // fraction of the step's interval, in [0, 1]
};

// What the tip and the lever do at one Z; frames and signs as in physics/contact.h. `events` holds `event_count` jumps
// in the order in which they happened within the step.
struct TipResponse {
  Force force;  // force of the sample on the tip
  Length tip_height;
  Length cantilever_deflection;
  Length sample_deformation;
  Phase phase = Phase::WaitForLift;
  std::array<ModelEvent, 2> events{};
  std::uint32_t event_count = 0;

  void add(const ModelEvent& event) noexcept { events[event_count++] = event; }
};

// How apex, lever and surface stand at one Z with one force on the tip; frames and signs as in physics/contact.h.
struct LeverState {
  Length tip_height;             // height of the apex above the undeformed surface, Z - delta_c
  Length cantilever_deflection;  // delta_c = -F/k_c
  Length sample_deformation;     // delta_s: of the support alone while free, tip height less the contact gap in contact
};
LeverState lever_state(const LawTables& tables, Phase phase, Length z, Force force) noexcept;

// That state as the response of a step without a jump.
TipResponse respond(const LawTables& tables, Phase phase, Length z, Force force) noexcept;

// A law of force as a two-state latch: Free until Z <= Z_jtc, Attached until Z >= Z_joc. The direction of motion is
// never consulted.
//
// - F is that of the free or of the attached branch of the law's tables; of a recorded curve in contact, that of
//   LawTables::contact_force().
// - The thresholds are looked for on the whole path between two steps, taken as straight, and the jump's place and
//   forces are the law's figures: they do not depend on where the samples fell.
// - No jump happens inside (Z_jtc, Z_joc); a wiggle there costs no work, and no closed path gives work.
// - A straight path holds at most one jump, since Z_jtc < Z_joc.
// - A law without hysteresis goes between Free and Attached where contact begins, without a jump.
// - A Z that is not finite gives zero force and the wait state.
//
// step() and wait_for_lift() do not allocate, lock or throw: they are for one servo thread.
class ApproachRetractModel {
 public:
  // Starts in WaitForLift. `tables` must not be null; shared, because a curve, a panel and the servo may hold the same.
  explicit ApproachRetractModel(std::shared_ptr<const LawTables> tables);

  // The paper's law. Throws as build_law_tables() does.
  explicit ApproachRetractModel(const ContactParameters& contact);

  // The response at Z after the straight path from the Z of the step before, if there was one since the tip was lifted.
  TipResponse step(Length z) noexcept;

  // After a start, a change of material or a dropout: zero force until Z > Z_joc.
  void wait_for_lift() noexcept { phase_ = Phase::WaitForLift; }

  Phase phase() const noexcept { return phase_; }
  Length lowest_z() const noexcept { return lowest_z_; }  // deepest point of the current contact; valid while attached
  Law law() const noexcept { return tables_->law; }
  const ContactParameters& contact() const noexcept { return tables_->contact; }
  const CycleFigures& figures() const noexcept { return tables_->figures; }
  const LawTables& tables() const noexcept { return *tables_; }

 private:
  // Moves `phase_` on to z; the jump, if that was one.
  std::optional<ModelEvent> latch(Length z) noexcept;

  std::shared_ptr<const LawTables> tables_;
  Phase phase_ = Phase::WaitForLift;
  Length previous_z_;  // previous step; meaningless in WaitForLift
  Length lowest_z_;    // minimum since the jump to contact; meaningless unless Attached
};

}  // namespace afm::physics
