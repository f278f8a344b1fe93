// SPDX-License-Identifier: Apache-2.0
#include "haptics/potential_energy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"

namespace afm::haptics {

using physics::Phase;

namespace {

constexpr double kSpacingM = 1e-4;

struct BranchEnergy {
  std::vector<double> energy_j;  // energies of the nodes, zero at the highest one
  double stiffness_n_per_m = 0;
};

// Integrates from the highest node down, with Simpson's rule in every interval.
BranchEnergy integrate(const PotentialEnergy::ForceOverHeight& force_n, double lowest_m, std::size_t nodes) {
  BranchEnergy branch{.energy_j = std::vector<double>(nodes, 0.0)};
  double above_n = force_n(lowest_m + kSpacingM * static_cast<double>(nodes - 1));
  for (std::size_t i = nodes - 1; i-- > 0;) {
    const double height_m = lowest_m + kSpacingM * static_cast<double>(i);
    const double here_n = force_n(height_m);
    const double mean_n = (here_n + 4.0 * force_n(height_m + 0.5 * kSpacingM) + above_n) / 6.0;
    branch.energy_j[i] = branch.energy_j[i + 1] + kSpacingM * mean_n;
    branch.stiffness_n_per_m = std::max(branch.stiffness_n_per_m, (here_n - above_n) / kSpacingM);
    above_n = here_n;
  }
  return branch;
}

}  // namespace

PotentialEnergy::PotentialEnergy(const ForceOverHeight& free_n, const ForceOverHeight& attached_n, double jump_in_m,
                                 Range range)
    : lowest_m_(range.lowest_m) {
  AFM_CHECK(range.highest_m > range.lowest_m && std::isfinite(range.highest_m - range.lowest_m));
  const auto nodes = static_cast<std::size_t>(std::ceil((range.highest_m - range.lowest_m) / kSpacingM)) + 1;
  BranchEnergy free = integrate(free_n, lowest_m_, nodes);
  BranchEnergy attached = integrate(attached_n, lowest_m_, nodes);
  stiffness_n_per_m_ = std::max(free.stiffness_n_per_m, attached.stiffness_n_per_m);
  free_j_ = std::move(free.energy_j);
  attached_j_ = std::move(attached.energy_j);

  const double step_j = at(Phase::Free, jump_in_m) - at(Phase::Attached, jump_in_m);
  for (double& energy_j : attached_j_) energy_j += step_j;

  double least_j = at(Phase::Free, jump_in_m);
  for (std::size_t i = 0; i < nodes; ++i) {
    least_j = std::min(least_j, attached_j_[i]);
    if (lowest_m_ + kSpacingM * static_cast<double>(i) >= jump_in_m) least_j = std::min(least_j, free_j_[i]);
  }
  for (double& energy_j : free_j_) energy_j -= least_j;
  for (double& energy_j : attached_j_) energy_j -= least_j;
}

double PotentialEnergy::at(Phase phase, double height_m) const noexcept {
  if (phase == Phase::WaitForLift || !std::isfinite(height_m)) return 0.0;
  const std::vector<double>& energy_j = phase == Phase::Attached ? attached_j_ : free_j_;
  const double place = (height_m - lowest_m_) / kSpacingM;
  const double node = std::clamp(std::floor(place), 0.0, static_cast<double>(energy_j.size() - 2));
  const auto i = static_cast<std::size_t>(node);
  return energy_j[i] + (place - node) * (energy_j[i + 1] - energy_j[i]);
}

}  // namespace afm::haptics
