// SPDX-License-Identifier: Apache-2.0
#include "oscillator_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "least_squares.h"

namespace afm::fits {

namespace {

using Gradient = std::array<double, kOscillatorUnknowns>;

// The model's density, and its derivatives over it.
struct Modelled {
  double density = 0;
  Gradient log_gradient{};
};

Modelled modelled(const Oscillator& oscillator, double floor_scale, double frequency_hz) {
  const double r2 = std::pow(frequency_hz / oscillator.resonance_hz, 2);
  const double damping = r2 / (oscillator.quality_factor * oscillator.quality_factor);
  const double below = (1.0 - r2) * (1.0 - r2) + damping;
  Modelled at{density_at(oscillator, frequency_hz), {}};
  const double resonant = at.density - oscillator.floor;
  at.log_gradient[kResonance] = resonant * (-1.0 - (4.0 * r2 * (1.0 - r2) - 2.0 * damping) / below) / at.density;
  at.log_gradient[kQuality] = resonant * (-1.0 + 2.0 * damping / below) / at.density;
  at.log_gradient[kArea] = resonant / at.density;
  at.log_gradient[kFloor] = floor_scale / at.density;
  return at;
}

// sign(x) sqrt(2 (x - ln(1 + x))) and its derivative, by their series where the difference would lose its digits.
struct Residual {
  double value = 0, slope = 1;
};
Residual residual_of(double x) {
  if (std::abs(x) < 1e-3) return {x * (1.0 - x / 3.0 + 7.0 * x * x / 36.0), 1.0 - 2.0 * x / 3.0 + 7.0 * x * x / 12.0};
  const double value = std::copysign(std::sqrt(2.0 * (x - std::log1p(x))), x);
  return {value, x / ((1.0 + x) * value)};
}

}  // namespace

double density_at(const Oscillator& oscillator, double frequency_hz) {
  const double r2 = std::pow(frequency_hz / oscillator.resonance_hz, 2), q = oscillator.quality_factor;
  const double at_zero = 2.0 * oscillator.area / (std::numbers::pi * oscillator.resonance_hz * q);
  return oscillator.floor + at_zero / ((1.0 - r2) * (1.0 - r2) + r2 / (q * q));
}

std::vector<double> OscillatorProblem::unknowns_of(const Oscillator& oscillator) const {
  return {std::log(oscillator.resonance_hz), std::log(oscillator.quality_factor), std::log(oscillator.area),
          oscillator.floor / floor_scale_};
}

Oscillator OscillatorProblem::oscillator_of(std::span<const double> unknowns) const {
  return {std::exp(unknowns[kResonance]), std::exp(unknowns[kQuality]), std::exp(unknowns[kArea]),
          unknowns[kFloor] * floor_scale_};
}

double OscillatorProblem::deviance(const Oscillator& oscillator) const {
  double sum = 0.0;
  for (const SpectrumPoint& point : spectrum_) {
    const double density = density_at(oscillator, point.frequency_hz);
    if (!(density > 0.0)) return std::numeric_limits<double>::infinity();
    sum += std::pow(residual_of(point.density / density - 1.0).value, 2);
  }
  return sum;
}

double OscillatorProblem::minimise(std::vector<double>& unknowns) const {
  // a step to where the model is no density: far from any minimum, so that the step is not taken
  constexpr double kNoDensity = 1e6;
  const std::size_t n = spectrum_.size();
  const auto evaluate = [&](std::span<const double> at, std::span<double> residuals, std::span<double> jacobian) {
    const Oscillator oscillator = oscillator_of(at);
    for (std::size_t i = 0; i < n; ++i) {
      const Modelled model = modelled(oscillator, floor_scale_, spectrum_[i].frequency_hz);
      const double ratio = spectrum_[i].density / model.density;
      const bool usable = model.density > 0.0 && std::isfinite(ratio) && ratio > 0.0;
      const Residual residual = usable ? residual_of(ratio - 1.0) : Residual{kNoDensity, 0.0};
      if (!residuals.empty()) residuals[i] = residual.value;
      for (std::size_t c = 0; !jacobian.empty() && c < kOscillatorUnknowns; ++c) {
        jacobian[c * n + i] = usable ? -residual.slope * ratio * model.log_gradient[c] : 0.0;
      }
    }
  };
  return least_squares(evaluate, n, unknowns);
}

std::vector<double> OscillatorProblem::deviations(const Oscillator& oscillator) const {
  std::vector<double> all;
  all.reserve(spectrum_.size());
  for (const SpectrumPoint& point : spectrum_) {
    all.push_back(point.density / density_at(oscillator, point.frequency_hz) - 1.0);
  }
  return all;
}

std::array<double, kOscillatorUnknowns> OscillatorProblem::variances(const Oscillator& oscillator) const {
  // Cholesky factor of the information in the lower half, then the squares of the columns of its inverse
  std::array<Gradient, kOscillatorUnknowns> l{};
  for (const SpectrumPoint& point : spectrum_) {
    const Gradient gradient = modelled(oscillator, floor_scale_, point.frequency_hz).log_gradient;
    for (std::size_t i = 0; i < kOscillatorUnknowns; ++i) {
      for (std::size_t j = 0; j <= i; ++j) l[i][j] += gradient[i] * gradient[j];
    }
  }
  for (std::size_t j = 0; j < kOscillatorUnknowns; ++j) {
    for (std::size_t i = j; i < kOscillatorUnknowns; ++i) {
      for (std::size_t m = 0; m < j; ++m) l[i][j] -= l[i][m] * l[j][m];
      l[i][j] = i == j ? std::sqrt(l[j][j]) : l[i][j] / l[j][j];
    }
  }
  std::array<double, kOscillatorUnknowns> result{};
  for (std::size_t column = 0; column < kOscillatorUnknowns; ++column) {
    Gradient solved{};
    for (std::size_t i = column; i < kOscillatorUnknowns; ++i) {
      double sum = i == column ? 1.0 : 0.0;
      for (std::size_t m = column; m < i; ++m) sum -= l[i][m] * solved[m];
      solved[i] = sum / l[i][i];
      result[column] += solved[i] * solved[i];
    }
  }
  return result;
}

}  // namespace afm::fits
