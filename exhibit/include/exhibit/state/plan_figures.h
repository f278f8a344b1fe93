// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "exhibit/state/particles_now.h"
#include "physics/units.h"

namespace afm::exhibit {

// Demands of a planned push on a hand (docs/manipulation.md, M12 and M14), with rho the distance of tip and sphere
// at touch, the apex on the sample.
struct PlanFigures {
  physics::Length left;    // distance from the centre of the sphere to its planned place
  physics::Length aim;     // rho/cosh(left/rho): offset with which a push without steering does not lose the sphere
  physics::Velocity hand;  // rho in the hand over physics::kSteeringDelay; 0 until the scale of the hand is known
};

// Empty without a plan for a sphere of the set.
std::optional<PlanFigures> plan_figures(const ParticlesNow& now);

}  // namespace afm::exhibit
