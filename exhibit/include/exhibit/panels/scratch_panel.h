// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/state/particles_now.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// A soft sample that the tip scratches: state, load, depth and lateral force of the tip, the first groove at this load
// by the formula (M52), the speed of the hand up to which the tip presses fully, and the numbers of the file, whose
// sources are details and left out. The set of `now` has a soft sample.
render::DataPanel scratch_panel(const ParticlesNow& now, const Phrases& phrases);

// Removes everything that the chosen material's law contributes to the plot of force, since no law acts where the tip
// leaves marks: predicted curve, jumps and stage. Names the felt curve after the set, with axes that contain all of it.
// The set of `now` has a soft sample or ink.
void leave_law_out(const ParticlesNow& now, const Phrases& phrases, render::ForcePanel& plot);

}  // namespace afm::exhibit
