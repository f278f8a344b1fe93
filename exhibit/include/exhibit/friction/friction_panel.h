// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exhibit/friction/friction_history.h"
#include "exhibit/words/phrases.h"
#include "physics/friction/friction.h"
#include "render/frame.h"

namespace afm::exhibit {

// The friction loop: lateral force against lateral displacement as it grows, and half width, offset and slope of the
// last closed one. With FrictionLaw::None, explains how to enable friction.
render::ForcePanel friction_panel(const FrictionHistory& history, physics::FrictionLaw law, const Phrases& phrases);

}  // namespace afm::exhibit
