// SPDX-License-Identifier: Apache-2.0
#include "physics/direction_rule.h"

namespace afm::physics {

DirectionRuleModel::DirectionRuleModel(const ContactParameters& contact)
    : tables_(build_law_tables(Law::Paper, contact)) {}

TipResponse DirectionRuleModel::step(Length z) noexcept {
  if (!isfinite(z)) {
    previous_z_.reset();
    phase_ = Phase::Free;
    TipResponse nothing;
    nothing.phase = phase_;
    return nothing;
  }

  const bool in_contact_region = z < tables_->figures.z_jtc;
  const bool retracting_in_band = z < tables_->figures.z_joc && previous_z_ && z >= *previous_z_;
  const Phase before = phase_;
  phase_ = in_contact_region || retracting_in_band ? Phase::Attached : Phase::Free;
  previous_z_ = z;

  const Force pull = tables_->attached.force(z);
  const bool in_contact = phase_ == Phase::Attached;
  TipResponse response = respond(*tables_, phase_, z, in_contact ? pull : Force());
  if (phase_ != before) {
    response.add({.kind = in_contact ? EventKind::JumpToContact : EventKind::JumpOffContact,
                  .z = z,
                  .force_before = in_contact ? Force() : pull,
                  .force_after = in_contact ? pull : Force(),
                  .fraction = 1.0});
  }
  return response;
}

}  // namespace afm::physics
