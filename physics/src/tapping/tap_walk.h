// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/tapping_curve.h"
#include "physics/tapping/tapping_oscillator.h"

// The walks of a tapping curve in one direction. Each adds its points and jumps to a curve; the first height of a
// retract is the turning point, which the approach has added.
namespace afm::physics {

struct TapDirection {
  Branch branch = Branch::Approach;
  std::vector<Length> heights;
  std::function<void()> reached = {};  // callback at each height; may be empty
};

// A slow walk down and up again, in parts.
struct SlowWalk {
  std::vector<TapPoint> down, up;  // points of each way, from its highest Z
  std::optional<TapJump> in, off;  // jumps between the attractive and the repulsive state

  bool hysteretic() const { return in && off && off->z > in->z; }
};

SlowWalk slow_walk_of(const TappingCurve& curve, const DrivenLever& lever);

// Z at which the walk down passes from attraction to repulsion; the lowest Z if it never does.
Length meeting_of(const SlowWalk& walk, const DrivenLever& lever);

// True if two resting swings, the later one `step` below the other, lie on different branches.
bool jumped(const TapState& before, const TapState& after, const DrivenLever& lever, Length step);

void add_tap_point(TappingCurve& curve, const DrivenLever& lever, Branch branch, Length z, const RestingTap& tap);

// Walks from rest to rest along the branches, which it leaves exactly at their folds; ends early where the amplitude is
// less than `least`, and is lost, if `only_at_rest`, where TapPath says so.
void walk_slowly(AveragedFlow& flow, const TapDirection& direction, TapState& state, TappingCurve& curve,
                 Length least = Length(), bool only_at_rest = false);
void walk_slowly(TappingOscillator& tip, const TapDirection& direction, TappingCurve& curve);

// Walks at a constant speed.
void walk_moving(AveragedFlow& flow, const TapDirection& direction, Velocity speed, TapState& state,
                 TappingCurve& curve);
void walk_moving(TappingOscillator& tip, const TapDirection& direction, Velocity speed, TappingCurve& curve);

}  // namespace afm::physics
