// SPDX-License-Identifier: Apache-2.0
#include "correlated_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace afm::fits {

namespace {

constexpr std::size_t kLags = kMostNoiseOrder + 1;
constexpr double kNone = std::numeric_limits<double>::infinity();

using Orders = std::array<double, kMostNoiseOrder>;

// Sums over t of the products of residual and columns, each at two lags: with them the likelihood costs no pass over
// the curve.
class LaggedProducts {
 public:
  LaggedProducts(std::span<const double> residuals, std::span<const double> jacobian)
      : columns_(jacobian.size() / residuals.size() + 1), count_(residuals.size() - kMostNoiseOrder) {
    const std::size_t n = residuals.size();
    std::vector<double> rows(n * columns_);  // by time, the residual first
    for (std::size_t t = 0; t < n; ++t) {
      rows[t * columns_] = residuals[t];
      for (std::size_t c = 1; c < columns_; ++c)
        rows[t * columns_ + c] = jacobian[(c - 1) * n + t] / norm(jacobian, n, c - 1);
    }
    sums_.assign(kLags * kLags * columns_ * columns_, 0.0);
    for (std::size_t i = 0; i < kLags; ++i) {
      for (std::size_t j = 0; j <= i; ++j) add(rows, i, j);
    }
  }

  std::size_t columns() const { return columns_; }
  double count() const { return static_cast<double>(count_); }

  double at(std::size_t lag_a, std::size_t lag_b, std::size_t a, std::size_t b) const {
    if (lag_b > lag_a) {
      std::swap(lag_a, lag_b);
      std::swap(a, b);
    }
    return sums_[((lag_a * kLags + lag_b) * columns_ + a) * columns_ + b];
  }

 private:
  // keeps the elimination well conditioned
  static double norm(std::span<const double> jacobian, std::size_t n, std::size_t column) {
    double largest = 0.0;
    for (std::size_t t = 0; t < n; t += std::max<std::size_t>(1, n / 64)) {
      largest = std::max(largest, std::abs(jacobian[column * n + t]));
    }
    return largest > 0.0 ? largest : 1.0;
  }

  void add(const std::vector<double>& rows, std::size_t i, std::size_t j) {
    double* sums = &sums_[(i * kLags + j) * columns_ * columns_];
    for (std::size_t t = kMostNoiseOrder; t < kMostNoiseOrder + count_; ++t) {
      const double* a = &rows[(t - i) * columns_];
      const double* b = &rows[(t - j) * columns_];
      for (std::size_t row = 0; row < columns_; ++row) {
        for (std::size_t column = 0; column < columns_; ++column) sums[row * columns_ + column] += a[row] * b[column];
      }
    }
  }

  std::size_t columns_, count_;
  std::vector<double> sums_;
};

// Coefficients of a stationary process from its partial correlations (Durbin & Levinson).
std::vector<double> coefficients_of(std::span<const double> partial) {
  std::vector<double> c;
  for (std::size_t k = 0; k < partial.size(); ++k) {
    std::vector<double> next(c);
    for (std::size_t j = 0; j < k; ++j) next[j] = c[j] - partial[k] * c[k - 1 - j];
    next.push_back(partial[k]);
    c = std::move(next);
  }
  return c;
}

// Twice the negative restricted log-likelihood, but for a constant.
double deviance(const LaggedProducts& products, std::span<const double> coefficients) {
  std::array<double, kLags> filter{1.0};
  for (std::size_t j = 0; j < coefficients.size(); ++j) filter[j + 1] = -coefficients[j];
  const std::size_t size = products.columns();
  std::vector<double> whitened(size * size, 0.0);
  for (std::size_t i = 0; i <= coefficients.size(); ++i) {
    for (std::size_t j = 0; j <= coefficients.size(); ++j) {
      const double weight = filter[i] * filter[j];
      for (std::size_t a = 0; a < size; ++a) {
        for (std::size_t b = 0; b < size; ++b) whitened[a * size + b] += weight * products.at(i, j, a, b);
      }
    }
  }
  // eliminates the columns of the fit one by one: what is left of the residual's square is the sum after the fit
  double log_determinant = 0.0;
  for (std::size_t pivot = size - 1; pivot >= 1; --pivot) {
    const double p = whitened[pivot * size + pivot];
    if (!(p > 0.0)) return kNone;
    log_determinant += std::log(p);
    for (std::size_t a = 0; a < pivot; ++a) {
      const double factor = whitened[a * size + pivot] / p;
      for (std::size_t b = 0; b < pivot; ++b) whitened[a * size + b] -= factor * whitened[pivot * size + b];
    }
  }
  const double free = products.count() - static_cast<double>(size - 1);
  return whitened.front() > 0.0 ? free * std::log(whitened.front()) + log_determinant : kNone;
}

// Minimum over the partial correlations, one after the other by golden sections, until none moves.
std::vector<double> best_of_order(const LaggedProducts& products, std::size_t order, std::vector<double> partial) {
  constexpr double kMost = 0.9995, kClose = 1e-4;
  constexpr int kRounds = 12;
  constexpr double kGolden = std::numbers::phi - 1.0;
  partial.resize(order, 0.0);
  const auto value = [&] { return deviance(products, coefficients_of(partial)); };
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0.0;
    for (double& one : partial) {
      const double before = one;
      const double reach = round == 0 ? 2.0 : 0.2;
      double low = std::max(-kMost, before - reach), high = std::min(kMost, before + reach);
      const auto at = [&](double x) {
        one = x;
        return value();
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
  return partial;
}

}  // namespace

std::vector<double> noise_coefficients(std::span<const double> residuals, std::span<const double> jacobian) {
  constexpr std::size_t kFewest = 10 * kMostNoiseOrder;
  if (residuals.size() < kFewest) return {};
  const LaggedProducts products(residuals, jacobian);
  std::vector<double> partial, best;
  double least = deviance(products, {});
  for (std::size_t order = 1; order <= kMostNoiseOrder; ++order) {
    partial = best_of_order(products, order, partial);
    const double criterion = deviance(products, coefficients_of(partial)) + 2.0 * static_cast<double>(order);
    if (criterion < least) {
      least = criterion;
      best = partial;
    }
  }
  return coefficients_of(best);
}

std::size_t whiten(std::span<const double> coefficients, std::span<double> values) {
  const std::size_t order = coefficients.size();
  if (order == 0) return values.size();
  for (std::size_t t = order; t < values.size(); ++t) {
    double white = values[t];
    for (std::size_t j = 0; j < order; ++j) white -= coefficients[j] * values[t - 1 - j];
    values[t - order] = white;  // an earlier one, which nobody needs any more
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
