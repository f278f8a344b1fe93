// SPDX-License-Identifier: Apache-2.0
#include "haptics/passivity_observer.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace afm::haptics {

void PassivityObserver::integrate(const Tick& tick) noexcept {
  const double work_j = std::min(glm::dot(tick.commanded_n, tick.moved_m), glm::dot(tick.wanted_n, tick.moved_m));
  const double moved_m = glm::length(tick.moved_m);
  const double granted_j = (0.5 * tick.stiffness_n_per_m * moved_m + tick.oscillation_n) * moved_m;
  excess_j_ = std::max(0.0, excess_j_ + work_j + tick.stored_rise_j - granted_j);
}

double PassivityObserver::damping_n_s_per_m(const glm::dvec3& velocity_m_per_s, double period_s) const noexcept {
  if (excess_j_ <= kToleranceJ) return 0.0;
  const double damped_j_per_n_s_per_m = glm::dot(velocity_m_per_s, velocity_m_per_s) * period_s;
  // a hand at rest returns no energy, whatever the damping
  if (excess_j_ >= kMostDampingNSPerM * damped_j_per_n_s_per_m) return kMostDampingNSPerM;
  return excess_j_ / damped_j_per_n_s_per_m;
}

}  // namespace afm::haptics
