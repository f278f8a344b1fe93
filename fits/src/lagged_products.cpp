// SPDX-License-Identifier: Apache-2.0
#include "lagged_products.h"

#include <algorithm>
#include <cmath>

#include "lanes.h"

namespace afm::fits {

namespace {

// Size of a column, by which it is divided to keep the elimination well conditioned.
double size_of(std::span<const double> column) {
  double largest = 0.0;
  for (std::size_t t = 0; t < column.size(); t += std::max<std::size_t>(1, column.size() / 64)) {
    largest = std::max(largest, std::abs(column[t]));
  }
  return largest > 0.0 ? largest : 1.0;
}

}  // namespace

LaggedProducts::LaggedProducts(std::span<const double> residuals, std::span<const double> jacobian)
    : columns_(jacobian.size() / residuals.size() + 1), count_(residuals.size() - kMostNoiseOrder) {
  if (columns_ <= 2) {
    sum<2>(residuals, jacobian);
  } else if (columns_ <= 4) {
    sum<4>(residuals, jacobian);
  } else {
    sum<6>(residuals, jacobian);
  }
}

// The products at two lags are those of one lag, their difference, but for a few samples at the ends.
template <std::size_t width>
void LaggedProducts::sum(std::span<const double> residuals, std::span<const double> jacobian) {
  const std::size_t n = residuals.size();
  std::vector<double> rows(n * width);  // values by time, the residual first
  for (std::size_t t = 0; t < n; ++t) rows[t * width] = residuals[t];
  for (std::size_t c = 1; c < columns_; ++c) {
    const std::span<const double> column = jacobian.subspan((c - 1) * n, n);
    const double scale = 1.0 / size_of(column);
    for (std::size_t t = 0; t < n; ++t) rows[t * width + c] = scale * column[t];
  }
  using Products = std::array<std::array<Two, width / 2>, width>;
  const auto add = [&](std::size_t t, std::size_t lag, double sign, Products& products) {
    const double* const now = &rows[t * width];
    const double* const before = &rows[(t - lag) * width];
    unrolled<width / 2>([&](auto pair) {
      const Two other = sign * two_at(now + 2 * pair);
      unrolled<width>([&](auto row) { products[row][pair] += before[row] * other; });
    });
  };
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    Products whole{};
    for (std::size_t t = lag; t < n; ++t) add(t, lag, 1.0, whole);
    for (std::size_t i = lag; i < kLags; ++i) {
      // the later of both is delayed by this: samples from kMostNoiseOrder on, delayed
      const std::size_t delay = i - lag;
      Products products(whole);
      for (std::size_t t = lag; t < kMostNoiseOrder - delay; ++t) add(t, lag, -1.0, products);
      for (std::size_t t = n - delay; t < n; ++t) add(t, lag, -1.0, products);
      Triangle& sums = sums_[i * (i + 1) / 2 + delay];
      for (std::size_t row = 0, entry = 0; row < columns_; ++row) {
        for (std::size_t column = 0; column <= row; ++column, ++entry) {
          const double one = products[row][column / 2][column % 2], other = products[column][row / 2][row % 2];
          sums[entry] = lag == 0 ? one : one + other;
        }
      }
    }
  }
}

LaggedProducts::Triangle LaggedProducts::whitened(std::span<const double> filter) const {
  Triangle triangle{};
  const std::size_t count = entries();
  for (std::size_t i = 0, pair = 0; i < filter.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j, ++pair) {
      const double weight = filter[i] * filter[j];
      for (std::size_t entry = 0; entry < count; ++entry) triangle[entry] += weight * sums_[pair][entry];
    }
  }
  return triangle;
}

}  // namespace afm::fits
