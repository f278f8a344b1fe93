// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "curves/sample_model.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// The dial of a lever that taps: the swing as a pointer of length A at the angle of its phase lag, so that the free
// swing of a lever at its resonance points up, an attractive one to the left of it, and a repulsive one to the right.
// Every swing at rest that loses no energy in the sample ends on the circle. At the resonance, over a sample without
// such a loss, the states at this Z are shown as pointers, too. `model` is one that taps.
render::ForcePanel swing_panel(const curves::SampleModel& model, const scene::TipState& tip, const Phrases& phrases);

}  // namespace afm::exhibit
