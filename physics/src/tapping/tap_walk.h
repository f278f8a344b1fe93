// SPDX-License-Identifier: Apache-2.0
#pragma once

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
};

void add_tap_point(TappingCurve& curve, const DrivenLever& lever, Branch branch, Length z, const RestingTap& tap);

// From rest to rest along the branches, which it leaves exactly at their folds.
void walk_slowly(AveragedFlow& flow, const TapDirection& direction, TapState& state, TappingCurve& curve);
void walk_slowly(TappingOscillator& tip, const TapDirection& direction, TappingCurve& curve);

// At a constant speed.
void walk_moving(AveragedFlow& flow, const TapDirection& direction, Velocity speed, TapState& state,
                 TappingCurve& curve);
void walk_moving(TappingOscillator& tip, const TapDirection& direction, Velocity speed, TappingCurve& curve);

}  // namespace afm::physics
