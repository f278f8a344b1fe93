// SPDX-License-Identifier: Apache-2.0
#include "study/threshold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "distributions.h"

namespace afm::study {

namespace {

constexpr double kThresholdZ = 0.6744897501960817;  // z(0.75), the normal quantile
constexpr std::size_t kFewestTrials = 5;
constexpr double kBeyondLevels = 8.0;  // factor by which the prior exceeds the levels on both sides
constexpr double kUsualExponent = 1.4, kExponentSpread = 0.6;
constexpr double kBiasSpread = std::numbers::sqrt2;
constexpr double kLongestSignal = 40.0;  // bound beyond any normal distribution

double second_probability(double signal, double bias) {
  return 0.5 * kLapseRate + (1.0 - kLapseRate) * normal_cdf(signal - bias / std::numbers::sqrt2);
}

double signal_of(double log_level, double log_weber, double exponent) {
  return std::min(kLongestSignal, kThresholdZ * std::exp(exponent * (log_level - log_weber)));
}

// Table of log(second_probability) with small steps, because a fit evaluates it a million times.
class LogProbability {
 public:
  LogProbability() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i] = std::log(second_probability(-kReach + kStep * static_cast<double>(i), 0.0));
    }
  }

  double operator()(double z) const {
    const double place = (std::clamp(z, -kReach, kReach) + kReach) / kStep;
    const std::size_t below = std::min(values_.size() - 2, static_cast<std::size_t>(place));
    const double share = place - static_cast<double>(below);
    return values_[below] + share * (values_[below + 1] - values_[below]);
  }

 private:
  static constexpr double kReach = 8.0, kStep = 1.0 / 128.0;
  std::array<double, 2 * 8 * 128 + 1> values_{};
};

// Trials with the same level and the same position of the stronger stimulus.
struct TrialGroup {
  double log_level = 0;
  double sign = 1;
  double trials = 0;
  double second = 0;  // number of answers "second"
};

std::vector<TrialGroup> grouped(std::span<const ThresholdTrial> trials) {
  std::map<std::pair<double, bool>, TrialGroup> groups;
  for (const ThresholdTrial& trial : trials) {
    TrialGroup& group = groups[{trial.level, trial.second_stronger}];
    group.log_level = std::log(trial.level);
    group.sign = trial.second_stronger ? 1.0 : -1.0;
    group.trials += 1.0;
    group.second += trial.answered_second ? 1.0 : 0.0;
  }
  std::vector<TrialGroup> list;
  list.reserve(groups.size());
  for (const auto& [key, group] : groups) list.push_back(group);
  return list;
}

// Equidistant points with their posterior weights.
struct PosteriorAxis {
  double low, high;
  std::vector<double> weights;

  PosteriorAxis(double from, double to, std::size_t points) : low(from), high(to), weights(points) {}

  double step() const { return (high - low) / static_cast<double>(weights.size() - 1); }
  double at(std::size_t i) const { return low + step() * static_cast<double>(i); }
  double largest() const { return *std::max_element(weights.begin(), weights.end()); }

  // The part with practically all of the weight.
  PosteriorAxis narrowed() const {
    const double least = 1e-5 * largest();
    std::size_t first = 0, last = weights.size() - 1;
    while (first < last && weights[first + 1] < least) ++first;
    while (last > first && weights[last - 1] < least) --last;
    return {at(first), at(last), weights.size()};
  }

  double quantile(double share) const {
    std::vector<double> sums(weights.size());
    for (std::size_t i = 1; i < sums.size(); ++i) sums[i] = sums[i - 1] + 0.5 * (weights[i - 1] + weights[i]);
    const double wanted = share * sums.back();
    std::size_t i = 1;
    while (i + 1 < sums.size() && sums[i] < wanted) ++i;
    return at(i) - step() * (sums[i] - wanted) / std::max(sums[i] - sums[i - 1], 1e-300);
  }
};

struct Posterior {
  PosteriorAxis log_weber, log_exponent, bias;

  // Computes the weights of the three axes from the data and the prior.
  void weigh(const std::vector<TrialGroup>& groups) {
    static const LogProbability log_probability;
    std::vector<double> logs;
    logs.reserve(log_weber.weights.size() * log_exponent.weights.size() * bias.weights.size());
    std::vector<double> signals(groups.size());
    for (std::size_t w = 0; w < log_weber.weights.size(); ++w) {
      for (std::size_t b = 0; b < log_exponent.weights.size(); ++b) {
        const double exponent = std::exp(log_exponent.at(b));
        const double log_prior = -0.5 * std::pow((log_exponent.at(b) - std::log(kUsualExponent)) / kExponentSpread, 2);
        for (std::size_t i = 0; i < groups.size(); ++i) {
          signals[i] = groups[i].sign * signal_of(groups[i].log_level, log_weber.at(w), exponent);
        }
        for (std::size_t c = 0; c < bias.weights.size(); ++c) {
          const double shift = bias.at(c) / std::numbers::sqrt2;
          double sum = log_prior - 0.5 * std::pow(bias.at(c) / kBiasSpread, 2);
          for (std::size_t i = 0; i < groups.size(); ++i) {
            sum += groups[i].second * log_probability(signals[i] - shift) +
                   (groups[i].trials - groups[i].second) * log_probability(shift - signals[i]);
          }
          logs.push_back(sum);
        }
      }
    }
    share_out(logs);
  }

 private:
  void share_out(const std::vector<double>& logs) {
    const double most = *std::max_element(logs.begin(), logs.end());
    auto next = logs.begin();
    for (double& of_weber : log_weber.weights) {
      for (double& of_exponent : log_exponent.weights) {
        for (double& of_bias : bias.weights) {
          const double weight = std::exp(*next++ - most);
          of_weber += weight;
          of_exponent += weight;
          of_bias += weight;
        }
      }
    }
  }
};

// Range of the logarithms of the Weber fraction; inverted if no level is above 0.
std::pair<double, double> weber_range(std::span<const ThresholdTrial> trials) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const ThresholdTrial& trial : trials) {
    if (trial.level <= 0.0) continue;
    low = std::min(low, trial.level);
    high = std::max(high, trial.level);
  }
  return {std::log(low / kBeyondLevels), std::log(high * kBeyondLevels)};
}

Estimate median_and_quantiles(std::size_t n, const PosteriorAxis& axis) {
  return {n, axis.quantile(0.5), {axis.quantile(0.5 * kIntervalAlpha), axis.quantile(1.0 - 0.5 * kIntervalAlpha)}};
}

}  // namespace

ThresholdFit fitted_threshold(std::span<const ThresholdTrial> trials) {
  ThresholdFit fit;
  fit.weber_fraction.n = fit.bias.n = trials.size();
  fit.right = static_cast<std::size_t>(
      std::count_if(trials.begin(), trials.end(), [](const ThresholdTrial& trial) { return trial.right(); }));
  const auto [lowest, highest] = weber_range(trials);
  if (trials.size() < kFewestTrials || !(lowest < highest)) return fit;

  const std::vector<TrialGroup> groups = grouped(trials);
  constexpr double kSpreads = 2.5;
  const double usual = std::log(kUsualExponent);
  Posterior posterior{{lowest, highest, 36},
                      {usual - kSpreads * kExponentSpread, usual + kSpreads * kExponentSpread, 7},
                      {-3.0 * kBiasSpread, 3.0 * kBiasSpread, 15}};
  posterior.weigh(groups);
  // the ends of the prior are not bounds from the trials
  constexpr double kNotSmall = 0.1;
  const double of_a_bound = kNotSmall * posterior.log_weber.largest();
  const bool below = posterior.log_weber.weights.front() > of_a_bound;
  const bool above = posterior.log_weber.weights.back() > of_a_bound;
  for (int pass = 0; pass < 2; ++pass) {
    posterior = {posterior.log_weber.narrowed(), posterior.log_exponent.narrowed(), posterior.bias.narrowed()};
    posterior.weigh(groups);
  }

  const Estimate log_weber = median_and_quantiles(trials.size(), posterior.log_weber);
  fit.weber_fraction.value = std::exp(log_weber.value);
  fit.weber_fraction.interval = {below ? 0.0 : std::exp(log_weber.interval.low),
                                 above ? std::numeric_limits<double>::infinity() : std::exp(log_weber.interval.high)};
  fit.bias = median_and_quantiles(trials.size(), posterior.bias);
  return fit;
}

}  // namespace afm::study
