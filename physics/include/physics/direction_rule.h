// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "physics/contact.h"
#include "physics/force_model.h"

namespace afm::physics {

// The flow chart of Liu & Peng, section 4, read literally ("paper-rule"): between Z_jtc and Z_joc the force is there
// whenever this sample is not below the one before. It exists to show what is wrong with it, and must never drive a
// device: it pulls on a tip that has never touched or that merely rests, lets go of one that still adheres, and
// chatters under the noise of a sensor. Its jumps lie at samples, so that they depend on the sample rate.
class DirectionRuleModel {
 public:
  // Throws std::invalid_argument as validate() does.
  explicit DirectionRuleModel(const Interaction& interaction);

  // As ApproachRetractModel::step, without a wait state: the first step counts as approaching.
  TipResponse step(Length z) noexcept;

  Phase phase() const noexcept { return phase_; }
  const Interaction& interaction() const noexcept { return interaction_; }
  const ApproachRetractEvents& events() const noexcept { return events_; }

 private:
  Interaction interaction_;
  ApproachRetractEvents events_;
  Phase phase_ = Phase::Free;
  std::optional<Length> previous_z_;
};

}  // namespace afm::physics
