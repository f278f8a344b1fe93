// SPDX-License-Identifier: Apache-2.0
#include "bootstrap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "curve_problem.h"
#include "profile.h"

namespace afm::fits {

namespace {

// 1 + 2 sum of the autocorrelations up to the first that is not positive.
double correlation_time(const std::vector<double>& residuals) {
  const std::size_t n = residuals.size();
  const auto product = [&](std::size_t lag) {
    return std::inner_product(residuals.begin() + static_cast<std::ptrdiff_t>(lag), residuals.end(), residuals.begin(),
                              0.0);
  };
  const double own = product(0);
  double time = 1.0;
  for (std::size_t lag = 1; own > 0.0 && lag < n / 4; ++lag) {
    const double shared = product(lag) / own;
    if (!(shared > 0.0)) break;
    time += 2.0 * shared;
  }
  return time;
}

std::size_t block_length(const std::vector<double>& residuals) {
  constexpr double kCorrelationTimes = 5.0;
  const auto n = static_cast<double>(residuals.size());
  const double length = std::max(std::cbrt(n), kCorrelationTimes * correlation_time(residuals));
  return static_cast<std::size_t>(std::ceil(std::clamp(length, 1.0, std::max(1.0, 0.25 * n))));
}

// Quantile of sorted values, interpolated between neighbours.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

Interval interval_of(std::vector<double> logarithms, double factor) {
  std::sort(logarithms.begin(), logarithms.end());
  return {factor * std::exp(quantile(logarithms, 0.025)), factor * std::exp(quantile(logarithms, 0.975))};
}

}  // namespace

std::optional<Bootstrap> bootstrap_of(std::span<const Sample> samples, const FitSetup& setup, const ElasticFit& fit) {
  const std::size_t n = samples.size();
  std::vector<double> residuals(n);
  for (std::size_t t = 0; t < n; ++t) residuals[t] = samples[t].force_n - fit.model_n[t];
  const double mean = std::accumulate(residuals.begin(), residuals.end(), 0.0) / static_cast<double>(n);
  for (double& residual : residuals) residual -= mean;
  Bootstrap found{.block = block_length(residuals)};

  FitSetup same(setup);
  same.indenter.shape = fit.shape;
  std::vector<Sample> resampled(samples.begin(), samples.end());
  std::vector<double> moduli, works;
  moduli.reserve(setup.bootstraps);
  works.reserve(setup.bootstraps);
  std::mt19937_64 random(1);
  for (std::size_t round = 0; round < setup.bootstraps; ++round) {
    for (std::size_t t = 0; t < n;) {
      const std::uint64_t first = random() % (n - found.block + 1);
      for (std::size_t i = 0; i < found.block && t < n; ++i, ++t) {
        resampled[t].force_n = fit.model_n[t] + residuals[first + i];
      }
    }
    const CurveProblem problem(resampled, same);
    Unknowns unknowns{std::log(fit.reduced_modulus_pa), fit.contact_z_m, fit.level_n};
    if (setup.tilt) unknowns.push_back(fit.tilt_n_per_m);
    if (fit.adhesion) unknowns.push_back(std::log(fit.adhesion->work_j_per_m2));
    if (!is_usable(unknowns, problem.minimise(unknowns, fit.noise))) continue;
    moduli.push_back(unknowns[kModulus]);
    if (fit.adhesion) works.push_back(unknowns[problem.work()]);
  }
  found.fits = moduli.size();
  if (found.fits == 0 || 2 * found.fits < setup.bootstraps) return std::nullopt;
  found.modulus_pa = interval_of(moduli, 1.0 - setup.poisson * setup.poisson);
  if (fit.adhesion) found.work_j_per_m2 = interval_of(works, 1.0);
  return found;
}

}  // namespace afm::fits
