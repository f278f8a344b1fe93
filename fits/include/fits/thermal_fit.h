// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fits/interval.h"

// Fit of a damped harmonic oscillator and a constant floor to the thermal noise of a free lever (docs/lever.md). Any
// thread; allocates.
namespace afm::fits {

// One point of a one-sided power spectrum. The signal may have any unit, such as V or m.
struct SpectrumPoint {
  double frequency_hz = 0;
  double density = 0;  // square of the signal's unit per hertz
};

struct Oscillator {
  double resonance_hz = 0;
  double quality_factor = 0;
  double area = 0;   // mean square of the oscillator's part of the signal, from 0 to infinity, as in equipartition
  double floor = 0;  // density of white noise; an estimate may be slightly negative
};

// (L1) floor + 2 A/(pi f0 Q) / [(1 - r^2)^2 + (r/Q)^2], r = f/f0: an oscillator under white force (fluctuation and
// dissipation).
double density_at(const Oscillator& oscillator, double frequency_hz);

// Reasons not to trust an area.
enum class SpectrumDoubt {
  OtherShape,     // groups of neighbours differ by more than chance
  TooCoarse,      // fewer than four points in the width f0/Q
  Unknown,        // standard deviation of the area above a tenth
  FewerAverages,  // scatter of fewer averages than were given
  Correlated      // neighbours more correlated than a window explains
};

struct SpectrumDoubtRow {
  SpectrumDoubt doubt;
  std::string_view name;  // name in reports
};
extern const std::array<SpectrumDoubtRow, 5> kSpectrumDoubts;

struct FoundInSpectrum {
  SpectrumDoubt doubt;
  double figure;  // value compared with `limit`, in its unit
  double limit;
};

struct ThermalFit {
  Oscillator oscillator;
  Interval resonance_hz, quality_factor, area, floor;
  double area_deviation = 0;            // relative standard deviation of the area
  double averages = 0;                  // number of averages assumed in the intervals
  std::optional<double> seen_averages;  // number of averages that fits the scatter; empty: no scatter
  double neighbour_factor = 1;          // growth of the variances because a window correlates neighbours
  std::size_t points = 0;
  double low_hz = 0, high_hz = 0;  // first and last frequency of the fit
  std::vector<FoundInSpectrum> doubts;
};

// Maximises Whittle's likelihood: each density is the mean of `averages` exponential ones around the model's. Without
// `averages` the scatter around the model determines them. Intervals come from the Fisher information. Empty, with the
// reason in `why`, if there are fewer than 20 points, frequencies do not rise from above zero, a density is not
// positive, or no oscillator within the frequencies fits.
std::optional<ThermalFit> fit_thermal(std::span<const SpectrumPoint> spectrum, std::optional<double> averages,
                                      std::string& why);

}  // namespace afm::fits
