// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <variant>

#include "core/result.h"
#include "physics/direction_rule.h"
#include "physics/force_model.h"

namespace afm::curves {
struct ContactSetup;
}

namespace afm::instrument {

// A tip at rest below a lever's base that is held by no feedback: its force follows from the path of the base, with
// both jumps. A law of a moving lever is taken at rest. Heights of the base in m above the undeformed surface, forces
// in N, positive away from the sample. One thread.
class HeldBase {
 public:
  // Starts far above. Fails as curves::run_curve() does.
  static core::Result<HeldBase> create(const curves::ContactSetup& setup);

  // Height at which a tip in contact is pushed with `force_n`; for a pull that no contact holds, height of the jump off
  // contact.
  double height_under(double force_n) const;

  void lift();                  // retracts the base to far above the sample
  void press(double height_m);  // moves the base from far above into contact and to this height
  void step(double height_m);   // moves the base along a straight path

  double force_n() const noexcept { return force_n_; }
  bool touches() const noexcept { return touches_; }

 private:
  using Model = std::variant<physics::ApproachRetractModel, physics::DirectionRuleModel>;
  explicit HeldBase(Model model) : model_(std::move(model)) { lift(); }

  const physics::LawTables& tables() const;

  Model model_;
  double force_n_ = 0.0;
  bool touches_ = false;
};

}  // namespace afm::instrument
