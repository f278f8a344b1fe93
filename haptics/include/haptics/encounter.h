// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <variant>

#include "core/result.h"
#include "haptics/device.h"
#include "haptics/energy_ledger.h"
#include "haptics/scaling.h"
#include "haptics/stored_energy.h"
#include "physics/dynamic_model.h"
#include "physics/force_model.h"
#include "physics/law_tables.h"
#include "scene/shared_blocks.h"

namespace afm::haptics {

// The tables of what is felt, and shown: of a dynamic lever those of the same lever at rest. Believes nothing of
// `material`; `curves` are those of its SharedModel. Fails with a line that begins with the material's name if its
// parameters have no such law. Takes milliseconds and allocates.
core::Result<std::shared_ptr<const physics::LawTables>> felt_tables(const scene::SharedMaterial& material,
                                                                    std::span<const scene::SharedMeasuredCurve> curves);

// What the hand meets with one material under the tip: its law of force, and the scale on which it is felt.
//
// create() takes milliseconds and allocates; the rest is for a tick of the servo.
class Encounter {
 public:
  // Fails as felt_tables() does, and if the device cannot show it at this tick period. `edit_revision` is of the
  // MaterialEdit that the material came with, 0 for none.
  static core::Result<std::unique_ptr<Encounter>> create(const scene::SharedMaterial& material,
                                                         std::uint32_t edit_revision,
                                                         std::span<const scene::SharedMeasuredCurve> curves,
                                                         const DeviceSpec& device, std::int64_t period_ns);

  physics::TipResponse step(physics::Length z) noexcept;
  void wait_for_lift() noexcept;
  physics::Phase phase() const noexcept;
  double slow_motion() const noexcept { return slow_motion_; }  // as in TipState

  const FitScaling& scaling() const noexcept { return scaling_; }
  const StoredEnergy& stored_energy() const noexcept { return stored_energy_; }

  // For the ledger, after the step that gave this response, with the hand at this height.
  EnergyLedger::Law energy(const physics::TipResponse& response, double hand_height_m) const noexcept;

  std::uint32_t edit_revision() const noexcept { return edit_revision_; }

 private:
  using Model = std::variant<physics::ApproachRetractModel, physics::DynamicModel>;

  Encounter(Model model, const FitScaling& scaling, StoredEnergy stored_energy,
            std::shared_ptr<const physics::LawTables> tables, std::uint32_t edit_revision);

  Model model_;  // never without a value, so that visiting it cannot throw
  FitScaling scaling_;
  StoredEnergy stored_energy_;
  std::shared_ptr<const physics::LawTables> tables_;  // at rest
  double slow_motion_;
  std::uint32_t edit_revision_;
};

}  // namespace afm::haptics
