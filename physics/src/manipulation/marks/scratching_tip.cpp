// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/scratching_tip.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "physics/quantity_text.h"
#include "require_range.h"

namespace afm::physics {
namespace {

constexpr int kSubStepsOfATick = 8, kStepsOfASubStep = 12, kGuesses = 3;
constexpr double kLongestGuess = 0.5;    // squares
constexpr double kShortestGuess = 0.02;  // squares: the first guess of a step is no shorter
constexpr double kGuessGrowth = 4.0;     // next guess over the last step
constexpr double kGuessShrinking = 8.0;  // divisor of a guess that gains nothing
constexpr double kLeastGain = 1e-9;      // least share of the energy that is worth another step

}  // namespace

void validate_lever(const PushSprings& springs) {
  for (const auto& [field, spring] :
       {std::pair{"lateral_spring", springs.lateral}, std::pair{"normal_spring", springs.normal}}) {
    require_range(field, spring, Stiffness(1e-4), Stiffness(1e6), kStiffnessUnits);
  }
}

ScratchingTip::ScratchingTip(const SphereCone& tip, const PushSprings& springs, const SoftSurface& surface,
                             const Sideways<Length>& least, const Sideways<Length>& most, const LeverBase& start)
    : springs_(springs), soft_(surface), surface_(tip, surface, least, most), last_way_m_(surface_.spacing().si) {
  validate_lever(springs);
  if (!surface_.holds(start.position)) throw std::invalid_argument("the start of the tip is outside the surface");
  tick_.base = tick_.apex = {start.position, std::max(start.z, surface_.highest())};
  move_to(start);
}

double ScratchingTip::stored_j(const Sideways<Length>& place, Length apex) const noexcept {
  const Sideways<Length> bent = place - tick_.base.position;
  const Length up = apex - tick_.base.z;
  return 0.5 * (springs_.lateral * dot(bent, bent) + springs_.normal * (up * up)).si;
}

Sideways<Force> ScratchingTip::pull() const noexcept {
  const Sideways<Length> bent = tick_.apex.position - tick_.base.position;
  return {springs_.lateral * bent.x, springs_.lateral * bent.y};
}

Force ScratchingTip::press() const noexcept { return springs_.normal * (tick_.apex.z - tick_.base.z); }

ScratchingTip::Step ScratchingTip::step_to(const Sideways<Length>& place) const noexcept {
  const Sunk sunk = surface_.sink(place, tick_.base.z, springs_.normal);
  return {place, sunk, stored_j(place, sunk.apex) + (soft_.hardness * sunk.displaced).si};
}

// The best of a step by a share of the gap to the base, of its half, and of the lowest place of the parabola through
// both and the present place.
ScratchingTip::Step ScratchingTip::best_towards(const Sideways<Length>& gap, double most) const noexcept {
  const auto at = [&](double share) {
    return step_to(share < 1.0 ? tick_.apex.position + gap * share : tick_.base.position);
  };
  const Step whole = at(most), half = at(0.5 * most);
  Step best = half.energy_j < whole.energy_j ? half : whole;
  const double now_j = tick_.stored.si, bend_j = whole.energy_j - 2.0 * half.energy_j + now_j;
  if (!(bend_j > 0.0)) return best;
  const double lowest = 0.5 - 0.25 * (whole.energy_j - now_j) / bend_j;
  if (!(lowest > 0.0 && lowest < 1.0)) return best;
  const Step third = at(lowest * most);
  return third.energy_j < best.energy_j ? third : best;
}

// True if the step has been taken.
bool ScratchingTip::take(const Step& step, const Sideways<double>& along) noexcept {
  if (!(step.energy_j < tick_.stored.si)) return false;
  tick_.apex = {step.place, step.sunk.apex};
  tick_.stops = step.sunk.stops;
  if (along.x != 0.0 || along.y != 0.0) along_ = along;
  if (step.sunk.displaced.si > 0.0) {
    const Force load = press();
    const bool dragged = along_.x != 0.0 || along_.y != 0.0;
    contact_radius_ = dragged ? groove_radius(soft_, load) : imprint_radius(soft_, load);
    const Volume pressed =
        surface_.press(step.place, step.sunk.apex, contact_radius_, spring_back(soft_, load, contact_radius_));
    tick_.lost = tick_.lost + soft_.hardness * pressed;
    tick_.state = ScratchState::Marks;
  }
  tick_.stored = Energy(stored_j(step.place, step.sunk.apex));
  surface_.pile_up(step.place, step.sunk.apex, contact_radius_, along_);
  return true;
}

void ScratchingTip::settle() noexcept {
  take(step_to(tick_.apex.position), {0.0, 0.0});
  const double longest_m = kLongestGuess * surface_.spacing().si, shortest_m = kShortestGuess * surface_.spacing().si;
  rested_ = false;
  for (int i = 0; i < kStepsOfASubStep && !rested_; ++i) {
    const Sideways<Length> gap = tick_.base.position - tick_.apex.position;
    const double gap_m = magnitude(gap).si, before_j = tick_.stored.si;
    rested_ = true;
    if (!(gap_m > 0.0)) return;
    const Sideways<double> along{gap.x.si / gap_m, gap.y.si / gap_m};
    double way_m = std::min({gap_m, longest_m, std::max(kGuessGrowth * last_way_m_, shortest_m)});
    for (int k = 0; k < kGuesses; ++k, way_m /= kGuessShrinking) {
      const Step step = best_towards(gap, way_m / gap_m);
      const Sideways<Length> from = tick_.apex.position;
      if (!take(step, along)) continue;
      last_way_m_ = magnitude(step.place - from).si;
      rested_ = before_j - step.energy_j <= kLeastGain * before_j;
      break;
    }
  }
}

void ScratchingTip::move_base(const LeverBase& base) noexcept {
  const Sideways<Length> way = base.position - tick_.base.position;
  const Length up = base.z - tick_.base.z;
  const auto work_of = [&] { return -1.0 * (dot(pull(), way) + press() * up); };
  const Energy at_start = work_of();
  tick_.base = base;
  const double frozen_j = stored_j(tick_.apex.position, tick_.apex.z);
  tick_.given = tick_.given + Energy(frozen_j - tick_.stored.si);
  tick_.stored = Energy(frozen_j);
  settle();
  tick_.work = tick_.work + 0.5 * (at_start + work_of());
}

const ScratchTick& ScratchingTip::move_to(const LeverBase& base) noexcept {
  if (!std::isfinite(base.z.si) || !surface_.holds(base.position)) return tick_;
  tick_.state = ScratchState::Free;
  tick_.lagging = false;
  const LeverBase from = tick_.base;
  if (base.z >= surface_.highest() && from.z >= surface_.highest() && tick_.stored.si == 0.0) {
    tick_.base = tick_.apex = base;
  } else {
    const Sideways<Length> way = base.position - from.position;
    const Length down = base.z - from.z;
    const double longest_m = kLongestGuess * surface_.spacing().si;
    const double steps = std::max(1.0, std::ceil(std::max(magnitude(way).si, std::abs(down.si)) / longest_m));
    tick_.lagging = steps > kSubStepsOfATick;
    for (int i = 1; i <= kSubStepsOfATick && i <= steps; ++i) {
      const double share = i / steps;
      move_base(i == steps ? base : LeverBase{from.position + way * share, from.z + down * share});
    }
    if (!rested_) ++tick_.exhausted;
  }
  tick_.lateral = pull();
  tick_.load = press();
  if (tick_.load.si > 0.0) {
    if (tick_.state == ScratchState::Free) tick_.state = ScratchState::Holds;
  } else if (!(surface_.volumes().under_way.si > 0.0)) {
    along_ = {0.0, 0.0};
  }
  return tick_;
}

}  // namespace afm::physics
