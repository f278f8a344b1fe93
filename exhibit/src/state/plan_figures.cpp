// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/plan_figures.h"

#include <cmath>
#include <cstddef>

#include "physics/manipulation/island.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/tip_contact.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {

using physics::Length;

std::optional<PlanFigures> plan_figures(const ParticlesNow& now) {
  const auto particle = static_cast<std::size_t>(now.plan.particle);  // huge without a plan
  if (particle >= now.set->particles.size()) return std::nullopt;
  const physics::PushSetup& setup = now.set->setup;
  const physics::ParticleSpecies& species = setup.species[now.set->particles[particle].species];
  if (physics::is_rod(species)) return std::nullopt;
  const Length rho = physics::core_radius(species) +
                     physics::side_contact(setup.tip, species.contact.tip_radius, Length(0.0)).distance;
  // an island that turns about the tip is lost more slowly
  const double kappa = physics::is_island(species) ? physics::kIslandTurning : 1.0;
  const auto pose = pose_of(now, particle);
  const double x_m = pose ? pose->x_m : now.plan.from_m[0], y_m = pose ? pose->y_m : now.plan.from_m[1];
  const Length left(std::hypot(now.plan.to_m[0] - x_m, now.plan.to_m[1] - y_m));
  return PlanFigures{.left = left,
                     .aim = physics::largest_offset(kappa * (left / rho)) * rho,
                     .hand = physics::fastest_steering(now.push.hand_m_per_m / kappa * rho, physics::kSteeringDelay)};
}

}  // namespace afm::exhibit
