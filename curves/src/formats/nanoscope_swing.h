// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "bytes/nanoscope_header.h"

namespace afm::curves {

// The base of a lever in PeakForce tapping, of which a file has one period a curve: a cosine without a separate
// channel. "Peak Force Amplitude" of the header is its amplitude in nanometres, "Sync Distance QNM", otherwise "Sync
// Distance", the time of its deepest point, counted like "Sample Points" in a period (as AtomicJ, pyAF and MagicAFM
// read it).
struct NanoscopeSwing {
  double amplitude_m = 0;
  double turn = 0;         // time of the deepest point, in captured points, from 0 to below `points`
  std::size_t points = 0;  // captured points of a period, an even number

  // The captured point with which the approach begins, half a period before the deepest one.
  std::size_t first() const;

  // Height of the base above its deepest point, metres, at each point of a period, from first() on.
  std::vector<double> heights_m() const;
};

// True if the curves of a file are those of PeakForce tapping.
bool is_peakforce_capture(const std::vector<NanoscopeBlock>& blocks);

// A period of PeakForce tapping whose heights were recorded: the point with which its approach begins, half a period
// before the deepest one, and the sign of a sensor that counts towards the sample.
struct SensedPeriod {
  std::size_t first = 0;
  double sign = 1.0;
};
inline constexpr const char* kSensedPeriod =
    "it is a period of PeakForce tapping with recorded heights; its force includes drag and inertia";

// The deepest point is that of the heights' first harmonic, on the side where the deflection is greatest. A period that
// begins within a fiftieth of itself from there is not turned. Points that are not numbers are left out; both have as
// many.
SensedPeriod sensed_period(const std::vector<double>& heights, const std::vector<double>& deflections);

// Swing in PeakForce tapping; `points` are captured in a period. Throws CurveError if the header lacks a number.
NanoscopeSwing nanoscope_swing(const std::vector<NanoscopeBlock>& blocks, std::size_t points);

}  // namespace afm::curves
