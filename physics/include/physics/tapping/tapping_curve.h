// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "physics/force_curve.h"
#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/tapping_oscillator.h"
#include "physics/units.h"

namespace afm::physics {

// Method of computation: averaged over a swing, for Q of at least AveragedFlow::kLeastQuality, or integrated
// directly.
enum class TapMethod { Averaged, Direct };

// The path of the base: down, and up again. Without a speed it waits at each step until the swing is at rest, and
// averaged swings change branch exactly at the folds. It begins with the free swing, and waits at both ends.
struct TapPath {
  SweepPlan plan;
  std::optional<Velocity> speed;
  // Averaged: lost also at the first height at which a swing is not at rest, as one that hovers where a latch closes,
  // or finds no shape over a stiff contact.
  bool only_at_rest = false;
};

// One row of the curve.
struct TapPoint {
  Length z;
  Branch branch = Branch::Approach;
  TapState state;
  Length deflection;       // x0, mean deflection
  SwingAverages averages;  // averages of the swing, including the true energy lost
  Energy cleveland;        // energy lost, inferred from amplitude and phase
  bool repeats = true;     // false: the swing differs from period to period, and the row shows one period
};

// A change between the states: a fold where one ends, or where the phase of a moving tip passes that of the free lever.
struct TapJump {
  Branch branch = Branch::Approach;
  Length z;         // Z of the jump; for direct integration with steps, between both rows
  Length z_before;  // Z of the row or fold before the jump
  Length z_after;   // Z of the row or fold after the jump
  TapState before;
  TapState after;
};

// A stable state off the path, at some heights.
struct TapIsland {
  Length lowest_z, highest_z;  // range of the sampled heights
  Length z;                    // height of the example, in the middle of the range
  RestingTap example;
};

struct TappingCurve {
  std::vector<TapPoint> points;  // approach, then retract; a fold is two points at its Z
  std::vector<TapJump> jumps;
  std::vector<TapIsland> islands;  // islands; only found by averaging
  Energy work_on_hand;             // work of the mean force over the loop; positive: the drive feeds the hand
  Area reduction_loop;             // loop integral of A0 - A over Z; negative: a push by it takes energy from the hand
  // Height at which Newton's method lost an averaged swing that goes on beyond it, as it may over a contact far stiffer
  // than the lever, or of TapPath::only_at_rest. The curve ends there, without loops and islands; direct integration
  // has no such place.
  std::optional<Length> lost_at;
};

// Throws std::invalid_argument as sample_count() does, for averaging below its least Q, for a speed that is not
// positive and finite, and for a path of more than kLongestTapPath swings or steps of the flow. Allocates. Any thread.
// `reached`, if there is one, is called with the number of heights that are done, those of the islands too, and of all.
inline constexpr double kLongestTapPath = 3e7;
using TapProgress = std::function<void(std::size_t done, std::size_t all)>;
TappingCurve record_tapping_curve(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                                  const TapPath& path, TapMethod method, const TapProgress& reached = {});

}  // namespace afm::physics
