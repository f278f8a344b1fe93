// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tap_table.h"

#include <algorithm>
#include <cmath>

#include "physics/tapping/tap_surface.h"
#include "physics/tapping/tapping_oscillator.h"
#include "tapping/tap_walk.h"

namespace afm::physics {
namespace {

constexpr double kAtRest = 1e-6;           // relative change of the amplitude in 50 swings of a resting state
constexpr double kJumpError = 1e-3;        // error of a jump's height, as a share of the free amplitude
constexpr double kFaintChange = 0.01;      // relative difference of the highest swing from the free one
constexpr double kMostReach = 10.0;        // highest base, in free amplitudes, for an attraction with a long range
constexpr double kClearlyRepelled = 0.02;  // sine of the phase, relative to the free lever, of a repelled swing

// Heights of the base in free amplitudes above contact, the highest first: dense where the tip begins to touch.
struct Zone {
  double to;
  int steps;
};
constexpr Zone kZones[] = {{1.1, 24}, {0.8, 60}, {-0.25, 48}};

std::vector<Length> heights_from(Length highest, Length contact, Length free_amplitude) {
  std::vector<Length> heights{highest};
  for (const Zone& zone : kZones) {
    const Length from = heights.back(), to = contact + zone.to * free_amplitude;
    for (int i = 1; i <= zone.steps; ++i) heights.push_back(from + (to - from) * (i / static_cast<double>(zone.steps)));
  }
  return heights;
}

// Height of the change of branch without a loop: where the phase has clearly passed that of the free lever; the lowest
// height if it never does.
Length repelled_from(const std::vector<TapPoint>& down, const DrivenLever& lever) {
  const auto repelled = std::find_if(down.begin(), down.end(), [&](const TapPoint& point) {
    return std::sin(point.state.phase - lever.free_phase) < -kClearlyRepelled;
  });
  return repelled == down.end() ? down.back().z : repelled->z;
}

// The first jump down from attraction to repulsion.
std::optional<TapJump> first_fall(const TappingCurve& curve, const DrivenLever& lever) {
  const auto in = std::find_if(curve.jumps.begin(), curve.jumps.end(), [&](const TapJump& jump) {
    return jump.branch == Branch::Approach && jump.after.phase < jump.before.phase &&
           jump.after.phase < lever.free_phase;
  });
  return in == curve.jumps.end() ? std::nullopt : std::optional(*in);
}

// The lowest height at which the free swing is hardly touched.
Length highest_of(TappingOscillator& tip, Length contact) {
  const DrivenLever& lever = tip.lever();
  const Length a0 = lever.free_amplitude;
  Length z = contact + 1.5 * a0 + Length(1e-9);
  for (; z < kMostReach * a0; z = z + 0.5 * a0) {
    tip.place(z, {a0, lever.free_phase});
    if (std::abs(tip.settle(kAtRest).state.amplitude / a0 - 1.0) < kFaintChange) break;
  }
  return z;
}

// Walks on from the swing that `tip` rests in; a jump is halved from copies of the tip before it.
void walk(TappingOscillator& tip, const TapDirection& direction, TappingCurve& curve) {
  const DrivenLever lever = tip.lever();
  const Length finest = kJumpError * lever.free_amplitude;
  RestingTap before = resting_tap(tip.settle(kAtRest));
  Length from = direction.heights.front();
  if (curve.points.empty()) add_tap_point(curve, lever, direction.branch, from, before);
  for (std::size_t i = 1; i < direction.heights.size(); ++i) {
    const Length to = direction.heights[i];
    TappingOscillator last = tip;
    tip.set_base(to);
    RestingTap after = resting_tap(tip.settle(kAtRest));
    if (jumped(before.state, after.state, lever, from - to)) {
      Length near = from, far = to;
      RestingTap beyond = after;
      while (abs(far - near) > finest) {
        const Length middle = 0.5 * (near + far);
        TappingOscillator half = last;
        half.set_base(middle);
        const RestingTap tap = resting_tap(half.settle(kAtRest));
        if (jumped(before.state, tap.state, lever, from - middle)) {
          far = middle;
          beyond = tap;
        } else {
          near = middle;
          before = tap;
          from = middle;
          last = half;
        }
      }
      add_tap_point(curve, lever, direction.branch, near, before);
      add_tap_point(curve, lever, direction.branch, near, beyond);
      curve.jumps.push_back({direction.branch, near, near, far, before.state, beyond.state});
    }
    add_tap_point(curve, lever, direction.branch, to, after);
    before = after;
    from = to;
  }
}

TappingCurve walk_down_and_up(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever) {
  TappingOscillator tip(surface, lever);
  const Length contact = surface->contact_height();
  const Length highest = highest_of(tip, contact);
  TapDirection down{Branch::Approach, heights_from(highest, contact, lever.free_amplitude)};
  TapDirection up{Branch::Retract, {down.heights.rbegin(), down.heights.rend()}};
  TappingCurve curve;
  tip.place(highest, {lever.free_amplitude, lever.free_phase});
  walk(tip, down, curve);
  walk(tip, up, curve);
  return curve;
}

}  // namespace

TapTable::TapTable(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever)
    : lever_(lever), walk_(walk_down_and_up(surface, lever)) {
  const SlowWalk slow = slow_walk_of(walk_, lever);
  lowest_ = slow.down.back().z;
  falls_m_ = leaves_m_ = repelled_from(slow.down, lever).si;
  const auto in = first_fall(walk_, lever);
  // a swing that was repelled before may jump to and fro near contact, which is no loop between the states
  if (in && slow.off && in->z.si >= falls_m_ && slow.off->z > in->z) {
    loop_ = TapLoop{*in, *slow.off};
    falls_m_ = in->z.si;
    leaves_m_ = slow.off->z.si;
  }
  attracted_ = branch_of(slow.down);
  repelled_ = branch_of(loop_ ? slow.up : slow.down);
}

std::vector<TapTable::Node> TapTable::branch_of(const std::vector<TapPoint>& points) {
  std::vector<Node> nodes;
  nodes.reserve(points.size());
  for (auto point = points.rbegin(); point != points.rend(); ++point) {
    const double a = point->state.amplitude.si;
    nodes.push_back({point->z.si,
                     {a * std::cos(point->state.phase), a * std::sin(point->state.phase), point->averages.lost.si,
                      point->averages.peak.si, point->averages.mean.si}});
  }
  return nodes;
}

TapTable::Rest TapTable::at(bool repelled, double z_m) const noexcept {
  const std::vector<Node>& nodes = repelled ? repelled_ : attracted_;
  // at a jump, two nodes at one height, the branch has the one on its own side
  const double z = repelled ? std::min(z_m, leaves_m_) : std::max(z_m, falls_m_);
  const auto lower = [](const Node& node, double height) { return node.z_m < height; };
  const auto upper = [](double height, const Node& node) { return height < node.z_m; };
  const auto above = repelled ? std::lower_bound(nodes.begin(), nodes.end(), z, lower)
                              : std::upper_bound(nodes.begin(), nodes.end(), z, upper);
  if (above == nodes.begin()) return nodes.front().rest;
  if (above == nodes.end()) return nodes.back().rest;
  const Node &a = *std::prev(above), &b = *above;
  const double share = b.z_m > a.z_m ? (z - a.z_m) / (b.z_m - a.z_m) : 0.0;
  const auto between = [&](double Rest::* value) { return a.rest.*value + share * (b.rest.*value - a.rest.*value); };
  return {between(&Rest::u_m), between(&Rest::v_m), between(&Rest::lost_j), between(&Rest::peak_force_n),
          between(&Rest::mean_force_n)};
}

std::vector<TapState> TapTable::states_at(Length z) const {
  const auto state_of = [&](bool repelled) {
    const Rest rest = at(repelled, z.si);
    return TapState{Length(std::hypot(rest.u_m, rest.v_m)), std::atan2(rest.v_m, rest.u_m)};
  };
  const bool both = falls_m_ < z.si && z.si < leaves_m_;
  if (!both) return {state_of(z.si <= falls_m_)};
  std::vector<TapState> states{state_of(false), state_of(true)};
  std::sort(states.begin(), states.end(),
            [](const TapState& a, const TapState& b) { return a.amplitude < b.amplitude; });
  return states;
}

}  // namespace afm::physics
