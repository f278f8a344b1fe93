// SPDX-License-Identifier: Apache-2.0
#include "physics/direction_rule.h"

namespace afm::physics {

DirectionRuleModel::DirectionRuleModel(const ContactParameters& contact)
    : tables_(build_law_tables(Law::Paper, contact)) {}

TipResponse DirectionRuleModel::step(Length z) noexcept {
  TipResponse response;
  if (!isfinite(z)) {
    previous_z_.reset();
    phase_ = Phase::Free;
    response.phase = phase_;
    return response;
  }

  const bool in_contact_region = z < tables_->figures.z_jtc;
  const bool retracting_in_band = z < tables_->figures.z_joc && previous_z_ && z >= *previous_z_;
  const Phase phase = in_contact_region || retracting_in_band ? Phase::Attached : Phase::Free;

  const Force pull = tables_->attached.force(z);
  if (phase != phase_) {
    ModelEvent& event = response.events[response.event_count++];
    const bool to_contact = phase == Phase::Attached;
    event.kind = to_contact ? EventKind::JumpToContact : EventKind::JumpOffContact;
    event.z = z;
    event.force_before = to_contact ? Force() : pull;
    event.force_after = to_contact ? pull : Force();
    event.fraction = 1.0;
  }
  phase_ = phase;
  previous_z_ = z;

  response.phase = phase_;
  response.force = phase_ == Phase::Attached ? pull : Force();
  const Pose pose = pose_of(*tables_, phase_, z, response.force);
  response.tip_height = pose.tip_height;
  response.cantilever_deflection = pose.cantilever_deflection;
  response.sample_deformation = pose.sample_deformation;
  return response;
}

}  // namespace afm::physics
