// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "correlated_noise.h"
#include "gram.h"

namespace afm::fits {

inline constexpr std::size_t kLags = kMostNoiseOrder + 1;

// Sums over the curve of the products of residuals and columns of a Jacobian, each at two lags: with them the
// likelihood of a noise costs no pass over the curve.
class LaggedProducts {
 public:
  static constexpr std::size_t kMostColumns = kMostUnknowns + 1;
  static constexpr std::size_t kMostEntries = kMostColumns * (kMostColumns + 1) / 2;

  // Symmetric matrix of the residuals, first, and the columns: row by row, up to the diagonal.
  using Triangle = std::array<double, kMostEntries>;

  // More residuals than kMostNoiseOrder, at most kMostUnknowns columns.
  LaggedProducts(std::span<const double> residuals, std::span<const double> jacobian);

  std::size_t columns() const { return columns_; }  // number of columns, including the residuals
  std::size_t entries() const { return columns_ * (columns_ + 1) / 2; }
  double count() const { return static_cast<double>(count_); }

  // Sum at two lags; for different lags the sum of both orders, since a filter weighs them alike.
  const Triangle& of(std::size_t lag, std::size_t other) const {
    return lag < other ? of(other, lag) : sums_[lag * (lag + 1) / 2 + other];
  }

  // Products of the whitened columns. The filter is 1 followed by the negative coefficients.
  Triangle whitened(std::span<const double> filter) const;

 private:
  template <std::size_t width>
  void sum(std::span<const double> residuals, std::span<const double> jacobian);

  std::size_t columns_, count_;
  std::array<Triangle, kLags*(kLags + 1) / 2> sums_{};
};

}  // namespace afm::fits
