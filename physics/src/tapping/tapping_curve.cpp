// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tapping_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "physics/quantity_text.h"
#include "tapping/tap_walk.h"

namespace afm::physics {
namespace {

// Down, and up again from the same turning point.
std::array<TapDirection, 2> directions_of(const SweepPlan& plan) {
  const std::uint64_t count = sample_count(plan), turn = count / 2;
  std::array<TapDirection, 2> both{TapDirection{Branch::Approach, {}}, TapDirection{Branch::Retract, {}}};
  for (std::uint64_t i = 0; i < count; ++i) {
    const Length z = sample_z(plan, i);
    if (i <= turn) both[0].heights.push_back(z);
    if (i >= turn) both[1].heights.push_back(z);
  }
  return both;
}

// Swings to integrate, or steps of the flow.
void require_length(const DrivenLever& lever, const TapPath& path, TapMethod method) {
  const auto rows = static_cast<double>(sample_count(path.plan));
  const double swings_a_row = method == TapMethod::Direct ? 8.0 * lever.quality_factor : 1.0;
  double swings = rows * swings_a_row;
  if (path.speed) {
    if (!(path.speed->si > 0.0 && isfinite(*path.speed))) {
      throw std::invalid_argument("a speed of " + format_quantity(*path.speed, kVelocityUnits) + " is not positive");
    }
    const Time duration = 2.0 * (path.plan.from - path.plan.to) / *path.speed;
    const double steps = method == TapMethod::Direct ? duration * (lever.ratio * lever.resonance)
                                                     : duration / (0.1 * lever.relaxation());
    swings = rows + steps;
  }
  if (swings <= kLongestTapPath) return;
  throw std::invalid_argument(std::string(method == TapMethod::Direct ? "direct integration" : "the path") +
                              " would take more than " + std::to_string(static_cast<long>(kLongestTapPath)) +
                              (method == TapMethod::Direct ? " swings" : " steps") +
                              ": take larger steps, a higher speed or a shorter path");
}

bool same_state(const TapState& a, const TapState& b) {
  constexpr double kSameAmplitude = 2e-3, kSamePhase = 0.02;
  return abs(a.amplitude - b.amplitude) < kSameAmplitude * b.amplitude && std::abs(a.phase - b.phase) < kSamePhase;
}

// Stride at which heights are searched for islands.
std::size_t stride_of_islands(std::size_t heights) {
  constexpr std::size_t kMostHeights = 100;
  return (heights + kMostHeights - 1) / kMostHeights;
}

// Stable states beside both directions of the path, looked for at a sample of its heights, from the highest down.
std::vector<TapIsland> islands_of(AveragedFlow& flow, const std::array<TapDirection, 2>& directions,
                                  const TappingCurve& curve) {
  const auto& heights = directions[0].heights;
  const std::size_t stride = stride_of_islands(heights.size());
  std::vector<std::vector<RestingTap>> beside;
  std::vector<TapIsland> islands;
  std::vector<std::size_t> newest;  // index of the last height of each island
  for (std::size_t i = 0; i < heights.size(); i += stride) {
    if (directions[0].reached) directions[0].reached();
    const Length z = heights[i];
    for (const RestingTap& tap : flow.resting_at(z)) {
      if (!tap.stable) continue;
      const bool reached = std::any_of(curve.points.begin(), curve.points.end(), [&](const TapPoint& point) {
        return point.z == z && same_state(point.state, tap.state);
      });
      if (reached) continue;
      const bool repels = tap.averages.virial < Energy();
      std::size_t n = 0;
      for (; n < islands.size(); ++n) {
        if (newest[n] + stride == i && (islands[n].example.averages.virial < Energy()) == repels) break;
      }
      if (n == islands.size()) {
        islands.push_back({z, z, z, tap});
        newest.push_back(i);
      }
      islands[n].lowest_z = z;
      newest[n] = i;
    }
  }
  for (TapIsland& island : islands) {
    // the sampled height nearest to the middle
    const Length middle = 0.5 * (island.lowest_z + island.highest_z);
    const bool repels = island.example.averages.virial < Energy();
    Length best = island.z;
    for (std::size_t i = 0; i < heights.size(); i += stride) {
      if (abs(heights[i] - middle) < abs(best - middle)) best = heights[i];
    }
    for (const RestingTap& tap : flow.resting_at(best)) {
      if (!tap.stable || (tap.averages.virial < Energy()) != repels) continue;
      island.z = best;
      island.example = tap;
    }
  }
  return islands;
}

void add_loops(TappingCurve& curve, const DrivenLever& lever) {
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const TapPoint &a = curve.points[i - 1], &b = curve.points[i];
    const Length rise = b.z - a.z;
    curve.work_on_hand = curve.work_on_hand + 0.5 * (a.averages.mean + b.averages.mean) * rise;
    const Length reduction = lever.free_amplitude - 0.5 * (a.state.amplitude + b.state.amplitude);
    curve.reduction_loop = curve.reduction_loop + reduction * rise;
  }
}

}  // namespace

TappingCurve record_tapping_curve(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                                  const TapPath& path, TapMethod method, const TapProgress& reached) {
  if (method == TapMethod::Averaged && lever.quality_factor < AveragedFlow::kLeastQuality) {
    throw std::invalid_argument("averaging needs a quality factor of at least 100: integrate directly");
  }
  require_length(lever, path, method);
  auto directions = directions_of(path.plan);
  const std::size_t rows = directions[0].heights.size();
  const std::size_t islands =
      method == TapMethod::Averaged && !path.speed ? 1 + (rows - 1) / stride_of_islands(rows) : 0;
  const std::size_t all = 2 * rows - 1 + islands;
  std::size_t done = 0;
  for (TapDirection& direction : directions) {
    if (reached) direction.reached = [&] { reached(std::min(++done, all), all); };
  }
  TappingCurve curve;
  if (method == TapMethod::Direct) {
    TappingOscillator tip(surface, lever);
    tip.place(path.plan.from, {lever.free_amplitude, lever.free_phase});
    for (const TapDirection& direction : directions) {
      path.speed ? walk_moving(tip, direction, *path.speed, curve) : walk_slowly(tip, direction, curve);
    }
    add_loops(curve, lever);
    return curve;
  }
  AveragedFlow flow(surface, lever);
  TapState state = flow.settle({lever.free_amplitude, lever.free_phase}, path.plan.from).state;
  for (const TapDirection& direction : directions) {
    path.speed ? walk_moving(flow, direction, *path.speed, state, curve)
               : walk_slowly(flow, direction, state, curve, Length(), path.only_at_rest);
    if (curve.lost_at) return curve;
  }
  add_loops(curve, lever);
  if (!path.speed) curve.islands = islands_of(flow, directions, curve);
  return curve;
}

}  // namespace afm::physics
