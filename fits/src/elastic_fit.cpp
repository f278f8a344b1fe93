// SPDX-License-Identifier: Apache-2.0
#include "fits/elastic_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "correlated_noise.h"
#include "curve_problem.h"
#include "doubts.h"
#include "profile.h"

namespace afm::fits {

namespace {

struct Span {
  double low = 0, high = 0;
};
Span heights_of(std::span<const Sample> samples) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end(),
                                               [](const Sample& a, const Sample& b) { return a.z_m < b.z_m; });
  return {low->z_m, high->z_m};
}

// Means of neighbours, so that looking for the best start costs little.
std::vector<Sample> thinned(std::span<const Sample> samples) {
  constexpr std::size_t kLeft = 256;
  if (samples.size() <= 2 * kLeft) return {samples.begin(), samples.end()};
  std::vector<Sample> means;
  for (std::size_t i = 0; i < kLeft; ++i) {
    const std::size_t begin = i * samples.size() / kLeft, end = (i + 1) * samples.size() / kLeft;
    Sample mean;
    for (std::size_t t = begin; t < end; ++t) {
      mean.z_m += samples[t].z_m / static_cast<double>(end - begin);
      mean.force_n += samples[t].force_n / static_cast<double>(end - begin);
    }
    means.push_back(mean);
  }
  return means;
}

double force_range_n(std::span<const Sample> samples) {
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end(),
                                               [](const Sample& a, const Sample& b) { return a.force_n < b.force_n; });
  return high->force_n - low->force_n;
}

std::optional<Unknowns> best_start(std::span<const Sample> samples, const FitSetup& setup) {
  const std::vector<Sample> few = thinned(samples);
  const CurveProblem problem(few, setup);
  const auto [low_m, high_m] = heights_of(few);
  std::vector<double> starts(setup.starts);
  for (const double share : {0.25, 0.5, 0.75}) starts.push_back(std::lerp(low_m, high_m, share));
  std::optional<Unknowns> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double start : starts) {
    auto unknowns = problem.start_at(start);
    if (!unknowns) continue;
    const double squares = problem.minimise(*unknowns);
    if (!is_usable(*unknowns, squares) || !(squares < least)) continue;
    least = squares;
    best = unknowns;
  }
  return best;
}

double squares_of(const std::vector<double>& residuals) {
  return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
}

// White first, then with the noise that is left, until its coefficients stay. Where another shape was pressed in, the
// residuals are no noise: a filter that takes them for it lets the model leave the curve, and is not used.
Ended minimum(const CurveProblem& problem, const Unknowns& start, bool white) {
  const int rounds = white ? 0 : 3;
  Ended white_noise{start, {}, false, 0.0};
  white_noise.squares = problem.minimise(white_noise.unknowns);
  Ended ended = white_noise;
  ended.filtered = !white;
  for (int round = 0; round < rounds; ++round) {
    auto noise = noise_coefficients(problem.residuals(ended.unknowns), problem.jacobian(ended.unknowns));
    double change = noise.size() == ended.noise.size() ? 0.0 : 1.0;
    for (std::size_t j = 0; change == 0.0 && j < noise.size(); ++j) {
      if (std::abs(noise[j] - ended.noise[j]) > 1e-3) change = 1.0;
    }
    if (change == 0.0) break;
    ended.noise = std::move(noise);
    ended.squares = problem.minimise(ended.unknowns, ended.noise);
  }
  constexpr double kLeftCurve = 4.0;  // largest ratio of the sums of squares
  const bool left = !is_usable(ended.unknowns, ended.squares) ||
                    squares_of(problem.residuals(ended.unknowns)) > kLeftCurve * white_noise.squares;
  return left ? white_noise : ended;
}

}  // namespace

std::optional<ElasticFit> fit(std::span<const Sample> samples, const FitSetup& setup, std::string& why) {
  const auto finite = [](const Sample& s) { return std::isfinite(s.z_m) && std::isfinite(s.force_n); };
  if (samples.size() < kFewest) {
    why = "it has fewer than 10 points of an approach";
    return std::nullopt;
  }
  if (!std::all_of(samples.begin(), samples.end(), finite)) {
    why = "a height or a force is not a number";
    return std::nullopt;
  }
  const auto [low_m, high_m] = heights_of(samples);
  if (!(high_m > low_m)) {
    why = "all its heights are the same";
    return std::nullopt;
  }
  const auto start = best_start(samples, setup);
  if (!start) {
    why = "the lever is nowhere pushed up: turned forces, or no contact";
    return std::nullopt;
  }
  const CurveProblem problem(samples, setup);
  Ended ended = minimum(problem, *start, setup.white);
  std::array<ProfileEnd, 2> ends;
  constexpr int kMostRestarts = 4;
  for (int restart = 0; restart < kMostRestarts; ++restart) {
    const double from_data_m = ended.unknowns[kContact] - std::clamp(ended.unknowns[kContact], low_m, high_m);
    if (!is_usable(ended.unknowns, ended.squares) || std::abs(from_data_m) > high_m - low_m) {
      why = "no modulus fits: the sample is not pushed, or the curve is no contact's";
      return std::nullopt;
    }
    const double deviation = deviation_of_modulus(problem, ended);
    // of a curve without noise there is no likelihood
    if (std::sqrt(ended.squares / static_cast<double>(samples.size())) < kRounding * force_range_n(samples)) {
      const double way = std::sqrt(kChiSquare95) * deviation, middle = ended.unknowns[kModulus];
      ends = {ProfileEnd{middle - way, std::nullopt}, ProfileEnd{middle + way, std::nullopt}};
      break;
    }
    ends = {profile_end(problem, ended, deviation, -1.0), profile_end(problem, ended, deviation, 1.0)};
    const auto& lower = ends[0].lower ? ends[0].lower : ends[1].lower;
    if (!lower) break;
    ended = minimum(problem, *lower, setup.white);
  }
  ElasticFit found;
  const double from_reduced = 1.0 - setup.poisson * setup.poisson;
  found.reduced_modulus_pa = std::exp(ended.unknowns[kModulus]);
  found.modulus_pa = from_reduced * found.reduced_modulus_pa;
  found.modulus_interval_pa = {from_reduced * std::exp(ends[0].log_modulus),
                               from_reduced * std::exp(ends[1].log_modulus)};
  found.contact_z_m = ended.unknowns[kContact];
  found.level_n = ended.unknowns[kLevel];
  if (setup.tilt) found.tilt_n_per_m = ended.unknowns[kTilt];
  std::vector<double> residuals = problem.residuals(ended.unknowns);
  double before_contact = 0.0;
  for (std::size_t t = 0; t < samples.size(); ++t) {
    const double depth_m = problem.depth_m(ended.unknowns, t);
    found.depth_m = std::max(found.depth_m, depth_m);
    if (depth_m > 0.0) ++found.in_contact;
    found.model_n.push_back(problem.force_n(ended.unknowns, t));
    if (!(depth_m > 0.0)) before_contact += residuals[t] * residuals[t];
  }
  found.points = samples.size();
  found.rms_n = std::sqrt(squares_of(residuals) / static_cast<double>(samples.size()));
  const std::size_t outside = samples.size() - found.in_contact;
  found.noise_n = outside < kFewest ? found.rms_n : std::sqrt(before_contact / static_cast<double>(outside));
  if (ended.filtered) found.noise_order = ended.noise.size();
  const std::size_t left = whiten(ended.noise, residuals);
  found.runs_p = runs_probability(std::span(residuals).first(left), std::min(outside, left));
  judge(samples, setup, problem, ended, found);
  return found;
}

}  // namespace afm::fits
