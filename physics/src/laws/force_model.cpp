// SPDX-License-Identifier: Apache-2.0
#include "physics/force_model.h"

#include <algorithm>
#include <utility>

namespace afm::physics {
namespace {

// Position of the threshold on the straight path from `from` to `to`.
double fraction_of(Length threshold, Length from, Length to) noexcept {
  return std::clamp((threshold - from) / (to - from), 0.0, 1.0);
}

}  // namespace

LeverState lever_state(const LawTables& tables, Phase phase, Length z, Force force) noexcept {
  const Length deflection = -force / tables.contact.spring_constant;
  const Length tip_height = z - deflection;
  const Length deformation =
      phase == Phase::Attached ? tip_height - tables.contact_gap : -force / tables.contact.sample_stiffness;
  return {tip_height, deflection, deformation};
}

TipResponse respond(const LawTables& tables, Phase phase, Length z, Force force) noexcept {
  const LeverState lever = lever_state(tables, phase, z, force);
  return {.force = force,
          .tip_height = lever.tip_height,
          .cantilever_deflection = lever.cantilever_deflection,
          .sample_deformation = lever.sample_deformation,
          .phase = phase};
}

ApproachRetractModel::ApproachRetractModel(std::shared_ptr<const LawTables> tables) : tables_(std::move(tables)) {}

ApproachRetractModel::ApproachRetractModel(const ContactParameters& contact)
    : ApproachRetractModel(build_law_tables(Law::Paper, contact)) {}

std::optional<ModelEvent> ApproachRetractModel::latch(Length z) noexcept {
  const CycleFigures& figures = tables_->figures;
  if (phase_ == Phase::WaitForLift) {
    if (z > figures.z_joc) phase_ = Phase::Free;
  } else if (!figures.hysteretic) {
    phase_ = z <= figures.z_jtc ? Phase::Attached : Phase::Free;
    lowest_z_ = z;
  } else if (phase_ == Phase::Free && z <= figures.z_jtc) {
    // the path began above Z_jtc, or this would not be Free, so its lowest point is its end
    phase_ = Phase::Attached;
    lowest_z_ = z;
    return ModelEvent{EventKind::JumpToContact, figures.z_jtc, figures.force_before_jtc, figures.force_after_jtc,
                      fraction_of(figures.z_jtc, previous_z_, z)};
  } else if (phase_ == Phase::Attached && z >= figures.z_joc) {
    phase_ = Phase::Free;
    return ModelEvent{EventKind::JumpOffContact, figures.z_joc, figures.force_before_joc, figures.force_after_joc,
                      fraction_of(figures.z_joc, previous_z_, z)};
  }
  return std::nullopt;
}

TipResponse ApproachRetractModel::step(Length z) noexcept {
  if (!isfinite(z)) {
    phase_ = Phase::WaitForLift;
    return {};
  }
  const std::optional<ModelEvent> jump = latch(z);
  previous_z_ = z;

  Force force;
  if (phase_ == Phase::Attached) {
    lowest_z_ = std::min(lowest_z_, z);
    force = tables_->contact_force(z, lowest_z_);
  } else if (phase_ == Phase::Free) {
    force = tables_->free.force(z);
  }
  TipResponse response = respond(*tables_, phase_, z, force);
  if (jump) response.add(*jump);
  return response;
}

}  // namespace afm::physics
