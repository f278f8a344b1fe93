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

// Why no fit is tried; empty if one is.
std::string refusal_of(std::span<const Sample> samples) {
  const auto finite = [](const Sample& s) { return std::isfinite(s.z_m) && std::isfinite(s.force_n); };
  if (samples.size() < kFewest) return "it has fewer than 10 points of an approach";
  if (!std::all_of(samples.begin(), samples.end(), finite)) return "a height or a force is not a number";
  const auto [low_m, high_m] = heights_of(samples);
  return high_m > low_m ? "" : "all its heights are the same";
}

// A contact point that lies farther from the data than these are long is none.
bool is_contact(const Ended& ended, std::span<const Sample> samples) {
  const auto [low_m, high_m] = heights_of(samples);
  const double contact_m = ended.unknowns[kContact];
  return is_usable(ended.unknowns, ended.squares) &&
         std::abs(contact_m - std::clamp(contact_m, low_m, high_m)) <= high_m - low_m;
}

struct Minimum {
  Ended ended;
  Interval log_modulus;
};

// With its interval; a better minimum that is met on the way to an end becomes the start of another fit. Empty without
// a contact.
std::optional<Minimum> minimum_with_interval(const CurveProblem& problem, std::span<const Sample> samples,
                                             const Unknowns& start, bool white) {
  constexpr int kMostRestarts = 4;
  const double rounding_n = kRounding * force_range_n(samples);
  Minimum found{minimum(problem, start, white), {}};
  for (int restart = 0; restart < kMostRestarts; ++restart) {
    if (!is_contact(found.ended, samples)) return std::nullopt;
    const double deviation = deviation_of_modulus(problem, found.ended);
    // of a curve without noise there is no likelihood
    if (std::sqrt(found.ended.squares / static_cast<double>(samples.size())) < rounding_n) {
      const double way = std::sqrt(kChiSquare95) * deviation, middle = found.ended.unknowns[kModulus];
      found.log_modulus = {middle - way, middle + way};
      break;
    }
    const ProfileEnd low = profile_end(problem, found.ended, deviation, -1.0);
    const ProfileEnd high = profile_end(problem, found.ended, deviation, 1.0);
    found.log_modulus = {low.log_modulus, high.log_modulus};
    const auto& lower = low.lower ? low.lower : high.lower;
    if (!lower) break;
    found.ended = minimum(problem, *lower, white);
  }
  return found;
}

// Depths, forces and residuals at the minimum.
void describe(const CurveProblem& problem, const Ended& ended, ElasticFit& fit) {
  std::vector<double> residuals = problem.residuals(ended.unknowns);
  double before_contact = 0.0;
  fit.model_n.reserve(residuals.size());
  for (std::size_t t = 0; t < residuals.size(); ++t) {
    const double depth_m = problem.depth_m(ended.unknowns, t);
    fit.depth_m = std::max(fit.depth_m, depth_m);
    fit.model_n.push_back(problem.force_n(ended.unknowns, t));
    if (depth_m > 0.0) {
      ++fit.in_contact;
    } else {
      before_contact += residuals[t] * residuals[t];
    }
  }
  fit.points = residuals.size();
  fit.rms_n = std::sqrt(squares_of(residuals) / static_cast<double>(fit.points));
  const std::size_t outside = fit.points - fit.in_contact;
  fit.noise_n = outside < kFewest ? fit.rms_n : std::sqrt(before_contact / static_cast<double>(outside));
  if (ended.filtered) fit.noise_order = ended.noise.size();
  const std::size_t left = whiten(ended.noise, residuals);
  fit.runs_p = runs_probability(std::span(residuals).first(left), std::min(outside, left));
}

}  // namespace

std::optional<ElasticFit> fit(std::span<const Sample> samples, const FitSetup& setup, std::string& why) {
  why = refusal_of(samples);
  if (!why.empty()) return std::nullopt;
  const auto start = best_start(samples, setup);
  if (!start) {
    why = "the lever is nowhere pushed up: turned forces, or no contact";
    return std::nullopt;
  }
  const CurveProblem problem(samples, setup);
  const auto best = minimum_with_interval(problem, samples, *start, setup.white);
  if (!best) {
    why = "no modulus fits: the sample is not pushed, or the curve is no contact's";
    return std::nullopt;
  }
  ElasticFit found;
  const double from_reduced = 1.0 - setup.poisson * setup.poisson;
  const Unknowns& unknowns = best->ended.unknowns;
  found.reduced_modulus_pa = std::exp(unknowns[kModulus]);
  found.modulus_pa = from_reduced * found.reduced_modulus_pa;
  found.modulus_interval_pa = {from_reduced * std::exp(best->log_modulus.low),
                               from_reduced * std::exp(best->log_modulus.high)};
  found.contact_z_m = unknowns[kContact];
  found.level_n = unknowns[kLevel];
  if (setup.tilt) found.tilt_n_per_m = unknowns[kTilt];
  describe(problem, best->ended, found);
  judge(samples, setup, problem, best->ended, found);
  return found;
}

}  // namespace afm::fits
