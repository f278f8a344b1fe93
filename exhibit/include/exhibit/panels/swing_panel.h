// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "curves/sample_model.h"
#include "exhibit/words/phrases.h"
#include "physics/tapping/tap_portrait.h"
#include "render/frame.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// The dial of a lever that taps: the swing as a pointer of length A at the angle of its phase lag, so that the free
// swing of a lever at its resonance points up, an attractive one to the left of it, and a repulsive one to the right.
// Every swing at rest that loses no energy in the sample ends on the circle. The stable states at this Z have pointers,
// too; where there are several, a line is the edge between the swings that end in one and those that end in another. A
// lever of a TapTable has no edge.
//
// One thread. The picture of a new Z takes milliseconds.
class SwingDial {
 public:
  // `model` has a lever in tapping mode.
  render::ForcePanel panel(const curves::SampleModel& model, const scene::TipState& tip, const Phrases& phrases);

 private:
  const physics::TapPortrait& portrait(const curves::SampleModel& model, double z_m, double reach_m);

  std::shared_ptr<const physics::LawTables> tables_;  // tables of the newest sample; null: none yet
  std::shared_ptr<const physics::TapSurface> surface_;
  std::optional<std::int64_t> height_;  // height of the portrait, in steps
  physics::TapPortrait portrait_;
};

}  // namespace afm::exhibit
