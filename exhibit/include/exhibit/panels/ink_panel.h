// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/state/particles_now.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// Ink with which the tip writes: state and force of the tip, the line at its speed and the dot of its time by the
// formulas (M81, M80), the area covered, and the numbers of the file, whose sources are details and left out. The set
// of `now` has ink and a tip.
render::DataPanel ink_panel(const ParticlesNow& now, const Phrases& phrases);

}  // namespace afm::exhibit
