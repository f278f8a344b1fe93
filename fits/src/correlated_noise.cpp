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
    const std::size_t entries = columns_ * (columns_ + 1) / 2;
    sums_.reserve(kLags * (kLags + 1) / 2 * entries);
    for (std::size_t i = 0; i < kLags; ++i) {
      for (std::size_t j = 0; j <= i; ++j) add(rows, i, j);
    }
  }

  std::size_t columns() const { return columns_; }
  double count() const { return static_cast<double>(count_); }

  // The products of the whitened columns, of which the filter is 1 and the negative coefficients: the triangle of a
  // symmetric matrix, row by row, up to the diagonal.
  void whitened(std::span<const double> filter, std::vector<double>& triangle) const {
    triangle.assign(columns_ * (columns_ + 1) / 2, 0.0);
    const double* sums = sums_.data();
    for (std::size_t i = 0; i < filter.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const double weight = filter[i] * filter[j];
        for (double& entry : triangle) entry += weight * *sums++;
      }
    }
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

  // Of two different lags the sum of both orders, since the filter weighs them alike.
  void add(const std::vector<double>& rows, std::size_t i, std::size_t j) {
    std::vector<double> sums(columns_ * columns_, 0.0);
    for (std::size_t t = kMostNoiseOrder; t < kMostNoiseOrder + count_; ++t) {
      const double* a = &rows[(t - i) * columns_];
      const double* b = &rows[(t - j) * columns_];
      for (std::size_t row = 0; row < columns_; ++row) {
        for (std::size_t column = 0; column < columns_; ++column) sums[row * columns_ + column] += a[row] * b[column];
      }
    }
    for (std::size_t row = 0; row < columns_; ++row) {
      for (std::size_t column = 0; column <= row; ++column) {
        const double one = sums[row * columns_ + column], other = sums[column * columns_ + row];
        sums_.push_back(i == j ? one : one + other);
      }
    }
  }

  std::size_t columns_, count_;
  std::vector<double> sums_;  // a triangle of columns for each pair of lags
};

// Coefficients of a stationary process from its partial correlations (Durbin & Levinson).
Orders coefficients_in(std::span<const double> partial) {
  Orders c{};
  for (std::size_t k = 0; k < partial.size(); ++k) {
    const Orders before = c;
    for (std::size_t j = 0; j < k; ++j) c[j] = before[j] - partial[k] * before[k - 1 - j];
    c[k] = partial[k];
  }
  return c;
}
std::vector<double> coefficients_of(std::span<const double> partial) {
  const Orders c = coefficients_in(partial);
  return {c.begin(), c.begin() + static_cast<std::ptrdiff_t>(partial.size())};
}

// Twice the negative restricted log-likelihood for these partial correlations, but for a constant. The triangle is
// overwritten: a search asks a thousand times.
double deviance(const LaggedProducts& products, std::span<const double> partial, std::vector<double>& triangle) {
  std::array<double, kLags> filter{1.0};
  const Orders coefficients = coefficients_in(partial);
  for (std::size_t j = 0; j < partial.size(); ++j) filter[j + 1] = -coefficients[j];
  products.whitened(std::span(filter).first(partial.size() + 1), triangle);
  // eliminates the columns of the fit one by one: what is left of the residual's square is the sum after the fit
  const auto row = [&triangle](std::size_t a) { return &triangle[a * (a + 1) / 2]; };
  double log_determinant = 0.0;
  for (std::size_t pivot = products.columns() - 1; pivot >= 1; --pivot) {
    const double* last = row(pivot);
    const double p = last[pivot];
    if (!(p > 0.0)) return kNone;
    log_determinant += std::log(p);
    for (std::size_t a = 0; a < pivot; ++a) {
      const double factor = last[a] / p;
      double* here = row(a);
      for (std::size_t b = 0; b <= a; ++b) here[b] -= factor * last[b];
    }
  }
  const double free = products.count() - static_cast<double>(products.columns() - 1);
  return triangle.front() > 0.0 ? free * std::log(triangle.front()) + log_determinant : kNone;
}

// Minimum over the partial correlations, one after the other by golden sections, until none moves.
std::vector<double> best_of_order(const LaggedProducts& products, std::size_t order, std::vector<double> partial) {
  constexpr double kMost = 0.9995, kClose = 1e-4;
  constexpr int kRounds = 12;
  constexpr double kGolden = std::numbers::phi - 1.0;
  partial.resize(order, 0.0);
  std::vector<double> triangle;
  const auto value = [&] { return deviance(products, partial, triangle); };
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
  std::vector<double> partial, best, triangle;
  double least = deviance(products, {}, triangle);
  for (std::size_t order = 1; order <= kMostNoiseOrder; ++order) {
    partial = best_of_order(products, order, partial);
    const double criterion = deviance(products, partial, triangle) + 2.0 * static_cast<double>(order);
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
