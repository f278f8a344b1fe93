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

// A jump at the place where the path crossed its threshold.
struct ModelEvent {
  EventKind kind = EventKind::JumpToContact;
  Length z;
  Force force_before;     // force on the tip before the jump, signed as in physics/contact.h
  Force force_after;      // force on the tip after the jump, signed
  double fraction = 0.0;  // time of the jump as a fraction of the step's interval, in [0, 1]
};

// Response of tip and lever at one Z; frames and signs as in physics/contact.h. `events` contains `event_count` jumps
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

// Positions of apex, lever and surface at one Z with one force on the tip; frames and signs as in physics/contact.h.
struct LeverState {
  Length tip_height;             // height of the apex above the undeformed surface, Z - delta_c
  Length cantilever_deflection;  // delta_c = -F/k_c, deflection of the lever
  Length sample_deformation;     // delta_s: of the support only while free; tip height minus the contact gap in contact
};
LeverState lever_state(const LawTables& tables, Phase phase, Length z, Force force) noexcept;

// That state as the response of a step without a jump.
TipResponse respond(const LawTables& tables, Phase phase, Length z, Force force) noexcept;

// A force law as a two-state latch: Free until Z <= Z_jtc, Attached until Z >= Z_joc. The direction of motion has no
// influence.
//
// - F is that of the free or the attached branch of the law's tables; for a recorded curve in contact, that of
//   LawTables::contact_force().
// - Thresholds are checked on the whole path between two steps, assumed straight. A jump's place and forces come from
//   the law's figures, so they do not depend on the sampling.
// - No jump happens inside (Z_jtc, Z_joc); an oscillation there costs no work, and no closed path yields work.
// - A straight path contains at most one jump, since Z_jtc < Z_joc.
// - A law without hysteresis changes between Free and Attached where contact begins, without a jump.
// - A Z that is not finite gives zero force and the wait state.
//
// step() and wait_for_lift() do not allocate, lock or throw: they are for one servo thread.
class ApproachRetractModel {
 public:
  // Starts in WaitForLift. `tables` must not be null. It is shared so that a curve, a panel and the servo can use the
  // same tables.
  explicit ApproachRetractModel(std::shared_ptr<const LawTables> tables);

  // The paper's law. Throws as build_law_tables() does.
  explicit ApproachRetractModel(const ContactParameters& contact);

  // The response at Z after a straight path from the previous step's Z, if there was a step since the tip was lifted.
  TipResponse step(Length z) noexcept;

  // Resets the model at a start, a change of material or a dropout: no force until Z > Z_joc.
  void wait_for_lift() noexcept { phase_ = Phase::WaitForLift; }

  Phase phase() const noexcept { return phase_; }
  Length lowest_z() const noexcept { return lowest_z_; }  // deepest point of the current contact; valid while attached
  Law law() const noexcept { return tables_->law; }
  const ContactParameters& contact() const noexcept { return tables_->contact; }
  const CycleFigures& figures() const noexcept { return tables_->figures; }
  const LawTables& tables() const noexcept { return *tables_; }

 private:
  // Advances `phase_` to z. Returns the jump, if there was one.
  std::optional<ModelEvent> latch(Length z) noexcept;

  std::shared_ptr<const LawTables> tables_;
  Phase phase_ = Phase::WaitForLift;
  Length previous_z_;  // Z of the previous step; meaningless in WaitForLift
  Length lowest_z_;    // lowest Z since the jump to contact; meaningless unless Attached
};

}  // namespace afm::physics
