// SPDX-License-Identifier: Apache-2.0
#include "tapping/tap_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace afm::physics {
namespace {

// True if a swing continues unchanged within this distance, so that there is no fold. The steps of the flow may have
// turned the phase of one that does not feel them.
bool same_swing_beside(const TapState& before, const TapState& after, Length distance) {
  constexpr double kSamePhase = 0.02;  // tolerance of the phase, rad
  const double turned = std::remainder(after.phase - before.phase, 2.0 * std::numbers::pi);
  return abs(after.amplitude - before.amplitude) <= 2.0 * distance && std::abs(turned) < kSamePhase;
}

// True if a swing could rest: the drive sustains no larger one, and its phase has not turned on and on, as in the
// averaged flow of a lever far from its resonance.
bool could_rest(const TapState& state, const DrivenLever& lever) {
  constexpr double kMostTurn = 4.0 * std::numbers::pi, kRounding = 1.001;
  const Length largest = lever.base_amplitude * (lever.quality_factor / lever.ratio);
  return std::abs(state.phase) < kMostTurn && state.amplitude < kRounding * largest;
}

// True if the newest averages are those of this swing at rest, which `follows` knows already.
bool rests(AveragedFlow& flow, const RestingTap& tap, Length z, bool follows) {
  const bool shaped = flow.has_shape() || tap.averages.contact_share == 0.0;
  TapState here = tap.state;
  return shaped && (follows || flow.follow(here, z));
}

// True if the phase has turned by more than a right angle from one height to the next: beside the resonance a branch
// may end on either side of the free lever's phase.
bool turns_over(const TapState& before, const TapState& after) {
  return std::abs(std::remainder(after.phase - before.phase, 2.0 * std::numbers::pi)) > 0.5 * std::numbers::pi;
}

// A walk in one direction.
struct Walked {
  bool only_at_rest = false;
  bool follows = false;  // true: the swing is known to rest on a branch
  int false_folds = 0;   // number of places where Newton's method failed, though the swing continues beyond them
};

// Moves from rest at one height to rest at another, along the branch as far as it goes.
void move_at_rest(AveragedFlow& flow, Branch branch, Length from, Length to, TapState& state, TappingCurve& curve,
                  Walked& walked) {
  constexpr int kMostFalseFolds = 4;       // limit beyond which averages cannot follow this swing
  constexpr int kMostTries = 400;          // attempts; a fold takes some 100, more where Newton's method only creeps
  constexpr int kMostTriesOfOlder = 4000;  // attempts in older sessions, whose creeping walks replay as they were
  constexpr double kFoldError = 1e-18;     // error of a fold's height, m
  constexpr double kBeyondFold = 2e-12;  // m beyond a fold, from which the flow leaves its neighbourhood in finite time
  const double way = to.si - from.si;
  TapState here = state;
  const bool known = std::exchange(walked.follows, false);
  const auto settle = [&](Length z) {
    const TapState settled = flow.settle(state, z).state;
    TapState rest = settled;
    if (walked.only_at_rest && !flow.follow(rest, z)) curve.lost_at = z;
    return settled;
  };
  if (!known && !flow.follow(here, from)) {  // not at rest: a swing that hovers at the beginning of contact
    state = settle(to);
    return;
  }
  double at = from.si, step = way;
  int tries = 0;
  while (at != to.si) {
    if (++tries > (flow.is_of_older_sessions() ? kMostTriesOfOlder : kMostTries)) {
      curve.lost_at = Length(at);
      return;
    }
    const double next = std::abs(to.si - at) <= std::abs(step) ? to.si : at + step;
    if (flow.follow(state, Length(next))) {
      at = next;
      step *= 2.0;
      continue;
    }
    step *= 0.5;
    if (std::abs(step) > kFoldError) continue;
    const Length fold(at), beyond(at + std::copysign(kBeyondFold, way));
    const TapState landed = settle(beyond);
    if (curve.lost_at) return;
    TapState after = landed;
    flow.follow(after, fold);
    if (flow.is_as_felt() || !same_swing_beside(state, after, Length(kBeyondFold))) {
      add_tap_point(curve, flow.lever(), branch, fold, flow.describe(state, fold));
      add_tap_point(curve, flow.lever(), branch, fold, flow.describe(after, fold));
      curve.jumps.push_back({branch, fold, fold, fold, state, after});
    } else if (++walked.false_folds > kMostFalseFolds) {
      curve.lost_at = fold;
      return;
    }
    state = landed;
    at = beyond.si;
    step = to.si - at;
    here = landed;
    if (step * way <= 0.0 || !flow.follow(here, beyond)) {  // a fold within the last picometres, or no rest beyond it
      state = settle(to);
      return;
    }
  }
  walked.follows = true;
}

// The height at which the phase passes that of the free lever for the first time, with the states about one relaxation
// before and after.
class PhaseWatch {
 public:
  PhaseWatch(const DrivenLever& lever, Branch branch) : lever_(lever), branch_(branch) {}

  void see(Length z, double phase) {
    const double excess = phase - lever_.free_phase;
    // down it falls, up it rises
    const bool passed = branch_ == Branch::Approach ? last_ > 0.0 && excess <= 0.0 : last_ < 0.0 && excess >= 0.0;
    if (passed && !crossed_) crossed_ = z + (last_z_ - z) * (excess / (excess - last_));
    last_ = excess;
    last_z_ = z;
  }

  void report(TappingCurve& curve, std::size_t first_point, Length travel) const {
    if (!crossed_) return;
    const auto nearest = [&](Length z) {
      return *std::min_element(curve.points.begin() + static_cast<std::ptrdiff_t>(first_point), curve.points.end(),
                               [z](const TapPoint& a, const TapPoint& b) { return abs(a.z - z) < abs(b.z - z); });
    };
    const Length back = branch_ == Branch::Approach ? travel : -travel;
    const TapPoint before = nearest(*crossed_ + back), after = nearest(*crossed_ - back);
    curve.jumps.push_back({branch_, *crossed_, before.z, after.z, before.state, after.state});
  }

 private:
  DrivenLever lever_;
  Branch branch_;
  double last_ = 0.0;
  Length last_z_;
  std::optional<Length> crossed_;
};

}  // namespace

bool jumped(const TapState& before, const TapState& after, const DrivenLever& lever, Length step) {
  constexpr double kTurn = 10.0 * std::numbers::pi / 180.0;
  const bool passed = (before.phase > lever.free_phase) != (after.phase > lever.free_phase);
  return passed && std::abs(after.phase - before.phase) > kTurn &&
         abs(after.amplitude - before.amplitude + step) > 0.01 * lever.free_amplitude;
}

SlowWalk slow_walk_of(const TappingCurve& curve, const DrivenLever& lever) {
  SlowWalk walk;
  for (const TapPoint& point : curve.points) {
    (point.branch == Branch::Approach ? walk.down : walk.up).push_back(point);
  }
  std::reverse(walk.up.begin(), walk.up.end());
  // a branch may end a little beyond the lag of the free lever, so the ends count that the jumps lead to
  for (const TapJump& jump : curve.jumps) {
    const bool rises = jump.after.phase > jump.before.phase, attracted = jump.after.phase > lever.free_phase;
    if (jump.branch == Branch::Approach && !rises && !attracted) walk.in = jump;
    if (jump.branch == Branch::Retract && rises && attracted) walk.off = jump;
  }
  return walk;
}

Length meeting_of(const SlowWalk& walk, const DrivenLever& lever) {
  const auto repelled = std::find_if(walk.down.begin(), walk.down.end(),
                                     [&](const TapPoint& p) { return p.state.phase < lever.free_phase; });
  return repelled == walk.down.end() ? walk.down.back().z : repelled->z;
}

void add_tap_point(TappingCurve& curve, const DrivenLever& lever, Branch branch, Length z, const RestingTap& tap) {
  curve.points.push_back({z, branch, tap.state, tap.deflection, tap.averages,
                          cleveland_energy(lever, tap.state.amplitude, tap.state.phase)});
}

void walk_slowly(AveragedFlow& flow, const TapDirection& direction, TapState& state, TappingCurve& curve, Length least,
                 bool only_at_rest) {
  const auto& [branch, heights, reached] = direction;
  Walked walked{.only_at_rest = only_at_rest};
  for (std::size_t i = branch == Branch::Approach ? 0 : 1; i < heights.size(); ++i) {
    if (state.amplitude < least) return;
    if (i > 0) move_at_rest(flow, branch, heights[i - 1], heights[i], state, curve, walked);
    const RestingTap tap = flow.describe(state, heights[i]);
    const bool known = flow.is_as_felt() || (could_rest(state, flow.lever()) &&
                                             (!only_at_rest || rests(flow, tap, heights[i], walked.follows)));
    if (!curve.lost_at && !known) curve.lost_at = heights[i];
    if (curve.lost_at) return;
    add_tap_point(curve, flow.lever(), branch, heights[i], tap);
    if (reached) reached();
  }
}

void walk_slowly(TappingOscillator& tip, const TapDirection& direction, TappingCurve& curve) {
  const auto& [branch, heights, reached] = direction;
  for (std::size_t i = branch == Branch::Approach ? 0 : 1; i < heights.size(); ++i) {
    tip.set_base(heights[i]);
    const RestingTap tap = resting_tap(tip.settle());
    if (i > 0) {
      const TapPoint before = curve.points.back();
      const Length step = before.z - heights[i];
      const bool falls = jumped(before.state, tap.state, tip.lever(), step) || turns_over(before.state, tap.state);
      if (before.repeats && tap.stable && falls) {
        curve.jumps.push_back({branch, 0.5 * (before.z + heights[i]), before.z, heights[i], before.state, tap.state});
      }
    }
    add_tap_point(curve, tip.lever(), branch, heights[i], tap);
    curve.points.back().repeats = tap.stable;
    if (reached) reached();
  }
}

void walk_moving(AveragedFlow& flow, const TapDirection& direction, Velocity speed, TapState& state,
                 TappingCurve& curve) {
  const auto& [branch, heights, reached] = direction;
  const double w0 = flow.lever().angular_resonance();
  PhaseWatch watch(flow.lever(), branch);
  state = flow.settle(state, heights.front()).state;
  if (branch == Branch::Approach) {
    add_tap_point(curve, flow.lever(), branch, heights.front(), flow.describe(state, heights.front()));
  }
  const std::size_t first = curve.points.size() - 1;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const Length from = heights[i - 1], way = heights[i] - from;
    const double angle = std::abs(way.si) / speed.si * w0;
    const double steps = std::ceil(angle / flow.longest_step());
    for (double n = 0.0; n < steps; n += 1.0) {
      flow.step(state, from + way * ((n + 0.5) / steps), angle / steps);
      watch.see(from + way * ((n + 1.0) / steps), state.phase);
    }
    add_tap_point(curve, flow.lever(), branch, heights[i], flow.describe(state, heights[i]));
    if (reached) reached();
  }
  watch.report(curve, first, speed * flow.lever().relaxation());
}

void walk_moving(TappingOscillator& tip, const TapDirection& direction, Velocity speed, TappingCurve& curve) {
  const auto& [branch, heights, reached] = direction;
  PhaseWatch watch(tip.lever(), branch);
  tip.set_base(heights.front());
  RestingTap tap = resting_tap(tip.settle());
  if (branch == Branch::Approach) add_tap_point(curve, tip.lever(), branch, heights.front(), tap);
  const std::size_t first = curve.points.size() - 1;
  const double sign = branch == Branch::Approach ? -1.0 : 1.0;
  tip.move_base(sign * speed * Time(2.0 * std::numbers::pi / tip.lever().angular_drive()));
  for (std::size_t i = 1; i < heights.size(); ++i) {
    while (sign * (heights[i] - tip.base()).si > 0.0) {
      tap = resting_tap(tip.swing());
      watch.see(tip.base(), tap.state.phase);
    }
    add_tap_point(curve, tip.lever(), branch, heights[i], tap);
    if (reached) reached();
  }
  tip.move_base(Length());
  watch.report(curve, first, speed * tip.lever().relaxation());
}

}  // namespace afm::physics
