// SPDX-License-Identifier: Apache-2.0
#include "physics/force_model.h"

#include <algorithm>
#include <stdexcept>

#include "physics/quantity_text.h"

namespace afm::physics {

ApproachRetractModel::ApproachRetractModel(const Interaction& interaction)
    : interaction_(interaction),
      events_(approach_retract_events(interaction)),
      attached_{Force(), -events_.effective_stiffness} {
  if (events_.z_joc <= events_.z_jtc) {
    throw std::invalid_argument(
        "mean surface energy " + format_quantity(interaction.mean_surface_energy, kSurfaceEnergyUnits) +
        " is too weak: jump-off-contact at " + format_quantity(events_.z_joc, kLengthUnits) +
        " does not lie above jump-to-contact at " + format_quantity(events_.z_jtc, kLengthUnits));
  }
}

ModelEvent ApproachRetractModel::jump(EventKind kind, Length threshold, Length z) const noexcept {
  const bool to_contact = kind == EventKind::JumpToContact;
  ModelEvent event;
  event.kind = kind;
  event.z = threshold;
  event.force_before = (to_contact ? free_ : attached_).force(threshold);
  event.force_after = (to_contact ? attached_ : free_).force(threshold);
  event.fraction = std::clamp((threshold - previous_z_) / (z - previous_z_), 0.0, 1.0);
  return event;
}

TipResponse ApproachRetractModel::step(Length z) noexcept {
  TipResponse response;
  if (!isfinite(z)) {
    phase_ = Phase::WaitForLift;
    return response;
  }

  if (phase_ == Phase::WaitForLift) {
    if (z > events_.z_joc) phase_ = Phase::Free;
  } else if (phase_ == Phase::Free) {
    // the path began above Z_jtc, or this would not be Free; so its lowest point is its end
    if (z <= events_.z_jtc) {
      response.events[response.event_count++] = jump(EventKind::JumpToContact, events_.z_jtc, z);
      phase_ = Phase::Attached;
    }
  } else if (z >= events_.z_joc) {
    response.events[response.event_count++] = jump(EventKind::JumpOffContact, events_.z_joc, z);
    phase_ = Phase::Free;
  }
  previous_z_ = z;

  response.phase = phase_;
  response.force = (phase_ == Phase::Attached ? attached_ : free_).force(z);
  const RestPose pose = rest_pose(interaction_, z, response.force);
  response.tip_height = pose.tip_height;
  response.cantilever_deflection = pose.cantilever_deflection;
  response.sample_deformation = pose.sample_deformation;
  return response;
}

}  // namespace afm::physics
