// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/friction/friction_history.h"
#include "exhibit/words/phrases.h"
#include "physics/friction/friction.h"
#include "render/frame.h"

namespace afm::exhibit {

// The friction loop: lateral force against lateral displacement as it grows, and half width, offset and slope of the
// last closed one. Of strokes over many atoms of a lattice, the axes show the three periods around the tip, so that
// each slip is seen. With FrictionLaw::None, explains how to enable friction.
render::ForcePanel friction_panel(const FrictionHistory& history, const physics::FrictionParameters& friction,
                                  const Phrases& phrases);

}  // namespace afm::exhibit
