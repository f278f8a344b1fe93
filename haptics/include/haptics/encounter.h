// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/result.h"
#include "haptics/device.h"
#include "haptics/scaling.h"
#include "physics/force_model.h"
#include "scene/shared_blocks.h"

namespace afm::haptics {

// What the hand meets with one material under the tip: its law of force, and the scale on which it is felt.
//
// create() takes milliseconds and allocates; the rest is for a tick of the servo.
class Encounter {
 public:
  // Believes nothing of `material`. `edit_revision` is of the MaterialEdit that it came with, 0 for none. Fails with a
  // line that begins with the material's name if its parameters have no such law or the device cannot show it.
  static core::Result<std::unique_ptr<Encounter>> create(const scene::SharedMaterial& material,
                                                         std::uint32_t edit_revision,
                                                         std::span<const scene::SharedMeasuredCurve> curves,
                                                         const DeviceSpec& device);

  physics::TipResponse step(physics::Length z) noexcept { return model_.step(z); }
  void wait_for_lift() noexcept { model_.wait_for_lift(); }
  physics::Phase phase() const noexcept { return model_.phase(); }

  const FitScaling& scaling() const noexcept { return scaling_; }
  std::uint32_t edit_revision() const noexcept { return edit_revision_; }

 private:
  Encounter(const physics::ApproachRetractModel& model, const FitScaling& scaling, std::uint32_t edit_revision)
      : model_(model), scaling_(scaling), edit_revision_(edit_revision) {}

  physics::ApproachRetractModel model_;
  FitScaling scaling_;
  std::uint32_t edit_revision_;
};

}  // namespace afm::haptics
