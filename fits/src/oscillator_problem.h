// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fits/thermal_fit.h"

namespace afm::fits {

// Unknowns of an oscillator: logarithms of resonance, quality factor and area, and the floor over a scale.
inline constexpr std::size_t kOscillatorUnknowns = 4;
enum OscillatorUnknown : std::size_t { kResonance, kQuality, kArea, kFloor };

// Whittle's likelihood of a spectrum as a sum of squares. Up to constants, minus the logarithm is N sum(y/S - 1 -
// ln(y/S)) for densities y, the model S and N averages: half the squares of the residuals sign(y - S) sqrt(2 (y/S - 1 -
// ln(y/S))), the deviance residuals of a gamma distribution (McCullagh & Nelder 1989), times N.
class OscillatorProblem {
 public:
  // `spectrum` must outlive the problem; `floor_scale` is a positive density.
  OscillatorProblem(std::span<const SpectrumPoint> spectrum, double floor_scale)
      : spectrum_(spectrum), floor_scale_(floor_scale) {}

  std::vector<double> unknowns_of(const Oscillator& oscillator) const;
  Oscillator oscillator_of(std::span<const double> unknowns) const;

  // Sum of the squares; infinite where the model is nowhere a density.
  double deviance(const Oscillator& oscillator) const;

  // Moves the unknowns to the nearest minimum. Returns the deviance there; not finite if there is none.
  double minimise(std::vector<double>& unknowns) const;

  // Relative deviations y/S - 1.
  std::vector<double> deviations(const Oscillator& oscillator) const;

  // Variances of the unknowns for one average: the diagonal of the inverse Fisher information. Not finite if an unknown
  // has no effect.
  std::array<double, kOscillatorUnknowns> variances(const Oscillator& oscillator) const;

  double floor_scale() const { return floor_scale_; }

 private:
  std::span<const SpectrumPoint> spectrum_;
  double floor_scale_;
};

}  // namespace afm::fits
