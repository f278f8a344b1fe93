// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "physics/force_curve.h"
#include "physics/lever_dynamics.h"
#include "physics/tapping/tap_surface.h"
#include "physics/units.h"

namespace afm::physics {

// The resonance of a lever whose amplitude is kept constant by its drive, over the height of its mean position
// (Giessibl 1997):
//
//   df = -f0 V/(k A^2),   V = <F A cos> of a harmonic swing;   for A -> 0: df = -f0 F'/(2k).
struct FrequencyShiftPoint {
  Length z;  // mean height of the tip, without the mean deflection
  Frequency shift;
  Frequency small_amplitude_shift;  // shift in the limit of small amplitudes, by the gradient at the mean height
  SwingAverages averages;
};

// A place at which df turns. A feedback that keeps df constant holds the tip only on one side of it: with the sign for
// the slope above the highest turn, it runs away from the sample or into it where the slope has the other sign.
struct FrequencyShiftTurn {
  Length z;
  Frequency shift;
};

struct FrequencyShiftCurve {
  std::vector<FrequencyShiftPoint> points;  // points from the highest one down
  std::vector<FrequencyShiftTurn> turns;    // turns from the highest one down
};

// Shift at one height; throws as record_frequency_shift().
FrequencyShiftPoint frequency_shift_at(const TapSurface& surface, Frequency resonance, Length amplitude, Length z);

// A lever of this resonance and the surface's spring constant, with an amplitude within 1 pm to 10 um, on the way down;
// the swing has no memory, so the way up is the same. Throws UnphysicalValue, and std::invalid_argument as
// sample_count() does. Allocates. Any thread.
FrequencyShiftCurve record_frequency_shift(const TapSurface& surface, Frequency resonance, Length amplitude,
                                           const SweepPlan& plan);

}  // namespace afm::physics
