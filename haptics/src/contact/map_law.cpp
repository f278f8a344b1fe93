// SPDX-License-Identifier: Apache-2.0
#include "haptics/map_law.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace afm::haptics {

using physics::Phase;

namespace {

// Three neighbours along one coordinate, their weights, and the slopes of these by the coordinate.
struct Around {
  std::array<std::size_t, 3> law{};
  std::array<double, 3> weight{};
  std::array<double, 3> slope{};
};

// Neighbours of a coordinate; beyond the ends the outermost law counts again.
Around around(double at, std::size_t count) noexcept {
  const auto last = static_cast<double>(count - 1);
  // NaN goes to an end, too
  const double within = std::fmax(-0.5, std::fmin(at, last + 0.5));
  const double middle = std::fmin(std::floor(within + 0.5), last);
  const auto i = static_cast<std::size_t>(std::fmax(middle, 0.0));
  const double offset = within - static_cast<double>(i), before = 0.5 - offset, after = 0.5 + offset;
  return {{i > 0 ? i - 1 : 0, i, std::min(i + 1, count - 1)},
          {0.5 * before * before, 0.75 - offset * offset, 0.5 * after * after},
          {-before, -2.0 * offset, after}};
}

constexpr double kEverySo_m = 5e-4;  // distance of the heights at which limits are evaluated

template <class Visit>
void for_each_height(PotentialEnergy::Range heights, const Visit& visit) {
  for (double height_m = heights.lowest_m; height_m <= heights.highest_m; height_m += kEverySo_m) visit(height_m);
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
                     law.jump_in_m, law.jump_off_m, 0.0, 0.0});
    Branches& built = laws_.back();
    built.shift_j = built.free.at(law.jump_in_m).energy_j - built.attached.at(law.jump_in_m).energy_j;
    built.loss_j = std::max(
        0.0, built.attached.at(law.jump_off_m).energy_j + built.shift_j - built.free.at(law.jump_off_m).energy_j);
    most_loss_j_ = std::max(most_loss_j_, built.loss_j);
  }
}

double MapLaw::loss_j(const Place& place) const noexcept {
  const Mixture mixture = mixture_of(place);
  double loss_j = 0.0;
  for (std::size_t k = 0; k < kMixed; ++k) loss_j += mixture.weight[k] * laws_[mixture.law[k]].loss_j;
  return loss_j;
}

MapLaw::Mixture MapLaw::mixture_of(const Place& place) const noexcept {
  const Around x = around(place.at.x, columns_), y = around(place.at.y, rows_);
  Mixture mixture;
  std::size_t k = 0;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column, ++k) {
      mixture.law[k] = y.law[row] * columns_ + x.law[column];
      mixture.weight[k] = x.weight[column] * y.weight[row];
      mixture.slope[k] = {x.slope[column] * y.weight[row], x.weight[column] * y.slope[row]};
    }
  }
  return mixture;
}

MapLaw::Jumps MapLaw::jumps_at(const Mixture& mixture) const noexcept {
  Jumps jumps;
  for (std::size_t k = 0; k < kMixed; ++k) {
    const Branches& law = laws_[mixture.law[k]];
    jumps.in_m += mixture.weight[k] * law.jump_in_m;
    jumps.off_m += mixture.weight[k] * law.jump_off_m;
    jumps.in_slope += law.jump_in_m * mixture.slope[k];
  }
  return jumps;
}

MapLaw::Branch MapLaw::branch_of(const Mixture& mixture, const HeightPotential Branches::* which,
                                 double height_m) const noexcept {
  Branch branch;
  for (std::size_t k = 0; k < kMixed; ++k) {
    const HeightPotential::Value value = (laws_[mixture.law[k]].*which).at(height_m);
    branch.energy_j += mixture.weight[k] * value.energy_j;
    branch.force_n += mixture.weight[k] * value.force_n;
    branch.slope_j += value.energy_j * mixture.slope[k];
  }
  return branch;
}

// Attached branch, shifted so that its energy at the jump into contact is that of the free branch.
MapLaw::Branch MapLaw::attached_of(const Mixture& mixture, double height_m) const noexcept {
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

HeightPotential::Value MapLaw::value_of(const Branches& law, Phase phase, double height_m) const noexcept {
  if (phase == Phase::Free) return law.free.at(height_m);
  HeightPotential::Value value = law.attached.at(height_m);
  value.energy_j += law.shift_j;
  return value;
}

MapLaw::Steepness MapLaw::steepness(PotentialEnergy::Range heights) const {
  Steepness most;
  for (const Phase phase : {Phase::Free, Phase::Attached}) {
    // where some law has this branch; its neighbours are mixed in there
    double lowest_m = heights.lowest_m, highest_m = heights.highest_m;
    const auto in_m = [](const Branches& law) { return law.jump_in_m; };
    const auto off_m = [](const Branches& law) { return law.jump_off_m; };
    if (phase == Phase::Free) lowest_m = std::max(lowest_m, std::ranges::min(laws_, {}, in_m).jump_in_m);
    if (phase == Phase::Attached) highest_m = std::min(highest_m, std::ranges::max(laws_, {}, off_m).jump_off_m);
    const auto value = [&](std::size_t column, std::size_t row, double height_m) {
      return value_of(laws_[row * columns_ + column], phase, height_m);
    };
    const auto compare = [](Change& by, const HeightPotential::Value& here, const HeightPotential::Value& after,
                            const HeightPotential::Value& second) {
      by.energy_j = std::max(by.energy_j, std::abs(after.energy_j - here.energy_j));
      by.force_n = std::max(by.force_n, std::abs(after.force_n - here.force_n));
      by.second_energy_j =
          std::max(by.second_energy_j, std::abs(second.energy_j - 2.0 * after.energy_j + here.energy_j));
    };
    for_each_height({lowest_m, highest_m}, [&](double height_m) {
      for (std::size_t row = 0; row < rows_; ++row) {
        for (std::size_t column = 0; column < columns_; ++column) {
          const HeightPotential::Value here = value(column, row, height_m);
          const double below_n = value(column, row, height_m - HeightPotential::kSpacingM).force_n;
          most.stiffness_n_per_m =
              std::max(most.stiffness_n_per_m, (below_n - here.force_n) / HeightPotential::kSpacingM);
          // three in a row, or fewer at the end, where nothing of a map lies
          const std::size_t right = std::min(column + 1, columns_ - 1), above = std::min(row + 1, rows_ - 1);
          if (column + 2 < columns_) {
            compare(most.by_column, here, value(right, row, height_m), value(column + 2, row, height_m));
          }
          if (row + 2 < rows_) {
            compare(most.by_row, here, value(column, above, height_m), value(column, row + 2, height_m));
          }
          const double twist_j = value(right, above, height_m).energy_j - value(right, row, height_m).energy_j -
                                 value(column, above, height_m).energy_j + here.energy_j;
          for (Change* change : {&most.by_column, &most.by_row}) {
            change->second_energy_j = std::max(change->second_energy_j, std::abs(twist_j));
          }
        }
      }
    });
  }
  return most;
}

double MapLaw::least_j(PotentialEnergy::Range heights) const {
  double least = 0.0;
  for_each_height(heights, [&](double height_m) {
    for (const Branches& law : laws_) {
      if (height_m >= law.jump_in_m) least = std::min(least, value_of(law, Phase::Free, height_m).energy_j);
      if (height_m <= law.jump_off_m) least = std::min(least, value_of(law, Phase::Attached, height_m).energy_j);
    }
  });
  return least;
}

}  // namespace afm::haptics
