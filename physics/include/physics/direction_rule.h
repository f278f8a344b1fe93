// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "physics/force_model.h"

namespace afm::physics {

// The flow chart of Liu & Peng, section 4, read literally ("paper-rule"): between Z_jtc and Z_joc the force is on
// whenever this sample is not below the previous one. It exists to demonstrate its faults and must never drive a
// device: it pulls on a tip that has never touched or that is at rest, releases one that still adheres, and chatters
// under sensor noise. Its jumps are at samples, so they depend on the sample rate.
class DirectionRuleModel {
 public:
  // Throws as build_law_tables() does for the paper's law.
  explicit DirectionRuleModel(const ContactParameters& contact);

  // As ApproachRetractModel::step, but without a wait state: the first step counts as approaching.
  TipResponse step(Length z) noexcept;

  Phase phase() const noexcept { return phase_; }
  const ContactParameters& contact() const noexcept { return tables_->contact; }
  const CycleFigures& figures() const noexcept { return tables_->figures; }
  const LawTables& tables() const noexcept { return *tables_; }

 private:
  std::shared_ptr<const LawTables> tables_;  // tables shared between copies, so that copying the model is cheap
  Phase phase_ = Phase::Free;
  std::optional<Length> previous_z_;
};

}  // namespace afm::physics
