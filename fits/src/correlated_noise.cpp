// SPDX-License-Identifier: Apache-2.0
#include "correlated_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "noise_likelihood.h"

namespace afm::fits {

namespace {

constexpr double kMostPartial = 0.9995;  // largest magnitude of a partial correlation

// Coefficients of a stationary process from its partial correlations (Durbin & Levinson).
Orders coefficients_of(const Orders& partial, std::size_t order) {
  Orders c{};
  for (std::size_t k = 0; k < order; ++k) {
    const Orders before = c;
    for (std::size_t j = 0; j < k; ++j) c[j] = before[j] - partial[k] * before[k - 1 - j];
    c[k] = partial[k];
  }
  return c;
}

// Partial correlations of a process from its coefficients. Empty for a process that is not, or hardly, stationary.
std::optional<Orders> partial_of(Orders c, std::size_t order) {
  Orders partial{};
  for (std::size_t k = order; k-- > 0;) {
    const double last = partial[k] = c[k];
    if (!(std::abs(last) <= kMostPartial)) return std::nullopt;
    const Orders after = c;
    for (std::size_t j = 0; j < k; ++j) c[j] = (after[j] + last * after[k - 1 - j]) / (1.0 - last * last);
  }
  return partial;
}

// Solution of a symmetric system (Cholesky). Empty if its matrix is not positive.
std::optional<Orders> solved(OrderMatrix l, Orders right, std::size_t order) {
  for (std::size_t i = 0; i < order; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = l[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i == j && !(sum > 0.0)) return std::nullopt;
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
    for (std::size_t k = 0; k < i; ++k) right[i] -= l[i][k] * right[k];
    right[i] /= l[i][i];
  }
  for (std::size_t i = order; i-- > 0;) {
    for (std::size_t k = i + 1; k < order; ++k) right[i] -= l[k][i] * right[k];
    right[i] /= l[i][i];
  }
  return right;
}

// Minimum by Newton's method, within the stationary processes. Empty if it does not converge.
std::optional<Orders> stepped_minimum(const LaggedProducts& products, std::size_t order, Orders coefficients) {
  constexpr int kMostSteps = 20, kHalvings = 8;
  constexpr double kClose = 1e-6;  // size of the last step, whose error is about its square
  Deviance here = deviance_with_slopes(products, coefficients, order);
  for (int step = 0; step < kMostSteps; ++step) {
    auto change = solved(here.curvature, here.gradient, order);
    if (!change) change = solved(here.rounder, here.gradient, order);
    if (!change) return std::nullopt;
    double largest = 0.0;
    for (const double each : *change) largest = std::max(largest, std::abs(each));
    if (largest < kClose) return coefficients;
    double share = 1.0;
    for (int halving = 0;; ++halving, share *= 0.5) {
      if (halving == kHalvings) return std::nullopt;
      Orders tried(coefficients);
      for (std::size_t j = 0; j < order; ++j) tried[j] -= share * (*change)[j];
      if (!partial_of(tried, order)) continue;
      const Deviance there = deviance_with_slopes(products, tried, order);
      if (!(there.value < here.value)) continue;
      coefficients = tried;
      here = there;
      break;
    }
  }
  return std::nullopt;
}

// True if a process that is hardly stationary is likelier than a minimum: where the model misses the curve, the other
// minima are of no noise.
bool is_lower_at_the_edge(const LaggedProducts& products, std::size_t order, const Orders& coefficients) {
  auto partial = partial_of(coefficients, order);
  if (!partial) return true;
  partial->front() = kMostPartial;
  return deviance(products, coefficients_of(*partial, order), order) < deviance(products, coefficients, order);
}

// Minimum over the partial correlations, one after the other by golden sections, until none moves: slow, but ends
// wherever the process is hardly stationary.
Orders searched_minimum(const LaggedProducts& products, std::size_t order, Orders partial) {
  constexpr double kClose = 1e-4;
  constexpr int kRounds = 12;
  constexpr double kGolden = std::numbers::phi - 1.0;
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0.0;
    for (std::size_t k = 0; k < order; ++k) {
      double& one = partial[k];
      const double before = one;
      const double reach = round == 0 ? 2.0 : 0.2;
      double low = std::max(-kMostPartial, before - reach), high = std::min(kMostPartial, before + reach);
      const auto at = [&](double x) {
        one = x;
        return deviance(products, coefficients_of(partial, order), order);
      };
      double a = high - kGolden * (high - low), b = low + kGolden * (high - low), at_a = at(a), at_b = at(b);
      while (high - low > 0.5 * kClose) {
        if (at_a < at_b) {
          high = std::exchange(b, a);
          at_b = at_a;
          a = high - kGolden * (high - low);
          at_a = at(a);
        } else {
          low = std::exchange(a, b);
          at_a = at_b;
          b = low + kGolden * (high - low);
          at_b = at(b);
        }
      }
      one = 0.5 * (low + high);
      moved = std::max(moved, std::abs(one - before));
    }
    if (moved < kClose) break;
  }
  return coefficients_of(partial, order);
}

}  // namespace

std::vector<double> noise_coefficients(std::span<const double> residuals, std::span<const double> jacobian) {
  constexpr std::size_t kFewest = 10 * kMostNoiseOrder;
  if (residuals.size() < kFewest) return {};
  const LaggedProducts products(residuals, jacobian);
  Orders coefficients{};
  std::vector<double> best;
  double least = deviance(products, coefficients, 0);
  for (std::size_t order = 1; order <= kMostNoiseOrder; ++order) {
    // start from the order before, and a zero
    const auto stepped = stepped_minimum(products, order, coefficients);
    const bool ends = stepped && !is_lower_at_the_edge(products, order, *stepped);
    coefficients =
        ends ? *stepped : searched_minimum(products, order, partial_of(coefficients, order).value_or(Orders{}));
    const double criterion = deviance(products, coefficients, order) + 2.0 * static_cast<double>(order);
    if (criterion < least) {
      least = criterion;
      best.assign(coefficients.begin(), coefficients.begin() + static_cast<std::ptrdiff_t>(order));
    }
  }
  return best;
}

std::size_t whiten(std::span<const double> coefficients, std::span<double> values) {
  const std::size_t order = coefficients.size();
  if (order == 0) return values.size();
  for (std::size_t t = order; t < values.size(); ++t) {
    double white = values[t];
    for (std::size_t j = 0; j < order; ++j) white -= coefficients[j] * values[t - 1 - j];
    values[t - order] = white;  // place of an earlier value that is not needed any more
  }
  return values.size() - order;
}

double runs_probability(std::span<const double> residuals, std::size_t split) {
  double runs = 0.0, mean = 0.0, variance = 0.0;
  for (const auto part : {residuals.first(split), residuals.subspan(split)}) {
    constexpr std::size_t kFewest = 20;
    if (part.size() < kFewest) continue;
    std::vector<double> sorted(part.begin(), part.end());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    double above = 0.0, below = 0.0, here = 1.0;
    for (std::size_t t = 0; t < part.size(); ++t) {
      (part[t] > *middle ? above : below) += 1.0;
      if (t > 0 && (part[t] > *middle) != (part[t - 1] > *middle)) here += 1.0;
    }
    const double n = above + below, product = 2.0 * above * below;
    if (!(product > 0.0)) continue;
    runs += here;
    mean += product / n + 1.0;
    variance += product * (product - n) / (n * n * (n - 1.0));
  }
  return variance > 0.0 ? 0.5 * std::erfc(-(runs - mean) / std::sqrt(2.0 * variance)) : 1.0;
}

}  // namespace afm::fits
