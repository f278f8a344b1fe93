// SPDX-License-Identifier: Apache-2.0
#include "haptics/map_law.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace afm::haptics {

using physics::Phase;

namespace {

// Two neighbours along one coordinate, and the share of the second; a slope of zero beyond the ends.
struct Between {
  std::size_t first = 0, second = 0;
  double share = 0;
  double slope = 0;  // slope of the share by the coordinate
};

Between between(double at, std::size_t count) noexcept {
  const auto last = static_cast<double>(count - 1);
  if (!(at > 0.0)) return {};  // NaN, too
  if (at >= last) return {count - 1, count - 1, 0.0, 0.0};
  const double first = std::floor(at);
  const auto i = static_cast<std::size_t>(first);
  return {i, i + 1, at - first, 1.0};
}

}  // namespace

MapLaw::MapLaw(const std::vector<Law>& laws, std::size_t columns, PotentialEnergy::Range heights)
    : columns_(columns), rows_(columns > 0 ? laws.size() / columns : 0) {
  AFM_CHECK(rows_ > 0 && rows_ * columns_ == laws.size());
  laws_.reserve(laws.size());
  for (const Law& law : laws) {
    AFM_CHECK(law.jump_off_m >= law.jump_in_m);
    laws_.push_back({HeightPotential([&](double h) { return law.free_n(std::fmax(h, law.jump_in_m)); }, heights),
                     HeightPotential([&](double h) { return law.attached_n(std::fmin(h, law.jump_off_m)); }, heights),
                     law.jump_in_m, law.jump_off_m});
  }
}

MapLaw::Mixture MapLaw::mixture_of(const Place& place) const noexcept {
  const Between x = between(place.at.x, columns_), y = between(place.at.y, rows_);
  const auto law = [this](std::size_t column, std::size_t row) { return &laws_[row * columns_ + column]; };
  const double left = 1.0 - x.share, lower = 1.0 - y.share;
  return {{law(x.first, y.first), law(x.second, y.first), law(x.first, y.second), law(x.second, y.second)},
          {left * lower, x.share * lower, left * y.share, x.share * y.share},
          {glm::dvec2(-x.slope * lower, -y.slope * left), glm::dvec2(x.slope * lower, -y.slope * x.share),
           glm::dvec2(-x.slope * y.share, y.slope * left), glm::dvec2(x.slope * y.share, y.slope * x.share)}};
}

MapLaw::Jumps MapLaw::jumps_at(const Mixture& mixture) noexcept {
  Jumps jumps;
  for (std::size_t i = 0; i < mixture.laws.size(); ++i) {
    jumps.in_m += mixture.weight[i] * mixture.laws[i]->jump_in_m;
    jumps.off_m += mixture.weight[i] * mixture.laws[i]->jump_off_m;
    jumps.in_slope += mixture.laws[i]->jump_in_m * mixture.slope[i];
  }
  return jumps;
}

MapLaw::Branch MapLaw::branch_of(const Mixture& mixture, const HeightPotential Branches::* which,
                                 double height_m) noexcept {
  Branch branch;
  for (std::size_t i = 0; i < mixture.laws.size(); ++i) {
    const HeightPotential::Value value = (mixture.laws[i]->*which).at(height_m);
    branch.energy_j += mixture.weight[i] * value.energy_j;
    branch.force_n += mixture.weight[i] * value.force_n;
    branch.slope_j += value.energy_j * mixture.slope[i];
  }
  return branch;
}

// Shifted so that its energy at the jump into contact is that of the free branch.
MapLaw::Branch MapLaw::attached_of(const Mixture& mixture, double height_m) noexcept {
  const Jumps jumps = jumps_at(mixture);
  Branch branch = branch_of(mixture, &Branches::attached, height_m);
  const Branch before = branch_of(mixture, &Branches::free, jumps.in_m),
               after = branch_of(mixture, &Branches::attached, jumps.in_m);
  branch.energy_j += before.energy_j - after.energy_j;
  branch.slope_j += before.slope_j - after.slope_j + (after.force_n - before.force_n) * jumps.in_slope;
  return branch;
}

MapLaw::Felt MapLaw::at(Phase phase, const Place& place, double height_m) const noexcept {
  if (phase == Phase::WaitForLift) return {};
  const Mixture mixture = mixture_of(place);
  const Branch branch =
      phase == Phase::Attached ? attached_of(mixture, height_m) : branch_of(mixture, &Branches::free, height_m);
  return {.energy_j = branch.energy_j,
          .force_n = branch.force_n,
          .sideways_n = -branch.slope_j.x * place.column_slope - branch.slope_j.y * place.row_slope};
}

Phase MapLaw::next_phase(Phase phase, const Place& place, double height_m) const noexcept {
  const Mixture mixture = mixture_of(place);
  const Jumps jumps = jumps_at(mixture);
  switch (phase) {
    case Phase::WaitForLift:
      return height_m > jumps.off_m ? Phase::Free : phase;
    case Phase::Free:
      return height_m <= jumps.in_m ? Phase::Attached : phase;
    case Phase::Attached:
      break;
  }
  const bool above = height_m >= jumps.off_m && height_m > jumps.in_m;
  const double rise_j =
      above ? branch_of(mixture, &Branches::free, height_m).energy_j - attached_of(mixture, height_m).energy_j : 0.0;
  return above && rise_j <= 0.0 ? Phase::Free : Phase::Attached;
}

}  // namespace afm::haptics
