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

constexpr int kSubStepsOfATick = 8;
constexpr int kLooksOfATick = 16;
constexpr int kLooksOnAWay = 5;
constexpr int kLooksOfALift = 3;
constexpr int kFineSubSteps = 4;
constexpr double kLongestWay = 0.5;    // longest step, and motion of the base in a sub-step, in squares
constexpr double kFineWay = 0.25;      // motion of the base in a fine sub-step, in squares, if so many suffice
constexpr double kShortestWay = 0.02;  // distance of the first evaluation of a way, in squares
constexpr double kWayGrowth = 4.0;     // largest ratio of the distances of two successive evaluations
constexpr double kWorth = 1e-4;        // gain over the pull times a square that is worth no further evaluation
constexpr double kBalanced = 3e-3;     // slope over the pull of the lever below which the tip rests
constexpr double kInside = 0.1;        // smallest distance of an evaluation from both ends, over that between them

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

ScratchingTip::Step ScratchingTip::step_to(const Sideways<Length>& place, const Sideways<double>& along,
                                           Length about) noexcept {
  --looks_;
  const Sunk sunk = surface_.sink(place, along, tick_.base.z, springs_.normal, about);
  const Force pull = springs_.lateral * dot(tick_.base.position - place, along);
  return {place, sunk, stored_j(place, sunk.apex) + (soft_.hardness * sunk.displaced).si, (sunk.resistance - pull).si};
}

// The step of least E + R among some on the way to the base, the next one always where the slopes of those before let
// expect the least. Sets rested_.
ScratchingTip::Step ScratchingTip::least_on_the_way(const Sideways<Length>& gap,
                                                    const Sideways<double>& along) noexcept {
  const Sideways<Length> from = tick_.apex.position;
  const double gap_m = magnitude(gap).si, spacing_m = surface_.spacing().si;
  const double most_m = std::min(gap_m, kLongestWay * spacing_m);
  const Step here = step_to(from, along, tick_.apex.z);
  Step best = here;
  rested_ = false;
  // way, E + R and slope at the last look short of the least, and at the first one beyond it; 0: no slope is known
  double low_m = 0.0, low_j = here.energy_j, low_n = 0.0, high_m = most_m, high_j = 0.0, high_n = 0.0;
  const double pull_n = springs_.lateral.si * gap_m;
  double way_m = std::min(most_m, std::max(last_way_m_, kShortestWay * spacing_m));
  for (int i = 0; i < kLooksOnAWay && looks_ > 0; ++i) {
    const bool at_base = way_m >= gap_m;
    const Step step = step_to(at_base ? tick_.base.position : from + gap * (way_m / gap_m), along, best.sunk.apex);
    if (step.energy_j < best.energy_j) best = step;
    // slope at the start of a parabola through both
    if (i == 0) low_n = 2.0 * (step.energy_j - here.energy_j) / way_m - step.slope_n;
    const double before_m = low_m, before_n = low_n;
    (step.slope_n > 0.0 ? high_m : low_m) = way_m;
    (step.slope_n > 0.0 ? high_j : low_j) = step.energy_j;
    (step.slope_n > 0.0 ? high_n : low_n) = step.slope_n;
    // beyond the first look with a slope upwards, nothing pulls the tip any farther
    rested_ = high_n > 0.0 || -step.slope_n <= kBalanced * pull_n || low_m >= gap_m;
    if (std::abs(step.slope_n) <= kBalanced * pull_n || low_n >= 0.0 || low_m >= most_m) break;
    if (high_n > 0.0) {
      // Between both ways the sum is nowhere below its tangents there. A square that begins to bear bends it sharply:
      // then the least is where the tangents meet, otherwise where the slope is 0 on a straight line.
      const double long_m = high_m - low_m;
      const double meet = std::clamp((high_j - low_j - high_n * long_m) / ((low_n - high_n) * long_m), 0.0, 1.0);
      if (best.energy_j - (low_j + low_n * meet * long_m) <= kWorth * pull_n * spacing_m) break;
      const double share = i % 2 == 0 ? low_n / (low_n - high_n) : meet;
      way_m = low_m + std::clamp(share, kInside, 1.0 - kInside) * long_m;
    } else {
      const double bend = (low_n - before_n) / (low_m - before_m);
      way_m = std::min({most_m, kWayGrowth * low_m, bend > 0.0 ? low_m - low_n / bend : most_m});
    }
  }
  return best;
}

void ScratchingTip::take(const Step& step, const Sideways<double>& along) noexcept {
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
}

void ScratchingTip::settle() noexcept {
  do {
    const Sideways<Length> from = tick_.apex.position, gap = tick_.base.position - from;
    const double gap_m = magnitude(gap).si;
    const Sideways<double> along =
        gap_m > 0.0 ? Sideways<double>{gap.x.si / gap_m, gap.y.si / gap_m} : Sideways<double>{};
    rested_ = true;
    const Step step = gap_m > 0.0 ? least_on_the_way(gap, along) : step_to(from, along, tick_.apex.z);
    if (!(step.energy_j < tick_.stored.si)) return;
    const double way_m = magnitude(step.place - from).si;
    if (way_m > 0.0) last_way_m_ = way_m;
    take(step, way_m > 0.0 ? along : Sideways<double>{});
  } while (!rested_ && looks_ > 0);
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

void ScratchingTip::hold_over(const LeverBase& base) noexcept {
  if (!std::isfinite(base.z.si) || !surface_.holds(base.position)) return;
  const std::uint64_t exhausted = tick_.exhausted;
  tick_ = {};
  tick_.base = tick_.apex = {base.position, std::max(base.z, surface_.highest())};
  tick_.exhausted = exhausted;
  along_ = {0.0, 0.0};
  last_way_m_ = surface_.spacing().si;
  contact_radius_ = Length(0.0);
  rested_ = true;
  surface_.densify_what_waits();
}

void ScratchingTip::lift_base(Length up) noexcept {
  looks_ = kLooksOfALift;
  move_base({tick_.base.position, tick_.base.z + std::max(up, -kLongestWay * surface_.spacing())});
  tick_.lateral = pull();
  tick_.load = press();
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
    const double way_squares = std::max(magnitude(way).si, std::abs(down.si)) / surface_.spacing().si;
    const double steps = std::max({1.0, std::ceil(way_squares / kLongestWay),
                                   std::min<double>(kFineSubSteps, std::ceil(way_squares / kFineWay))});
    tick_.lagging = steps > kSubStepsOfATick;
    const int taken = static_cast<int>(std::min<double>(steps, kSubStepsOfATick));
    for (int i = 1; i <= taken; ++i) {
      const double share = i / steps;
      looks_ = kLooksOfATick / taken;
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
