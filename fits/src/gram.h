// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace afm::fits {

inline constexpr std::size_t kMostUnknowns = 5;

// Columns of a Jacobian, with the residuals as the first. That of the level is 1 everywhere, and not among them.
struct Columns {
  static constexpr std::size_t kMost = kMostUnknowns;  // limit: residuals, and all unknowns but the level

  std::array<const double*, kMost> values{};
  std::array<std::size_t, kMost> unknowns{};  // index of each column's unknown
  std::size_t count = 0, dense = 0;           // columns; the ones after `dense` are 0 before the sample `late`
  std::size_t late = 0, size = 0;             // first sample of the other columns, number of samples
  std::size_t level = 0;                      // index of the level's unknown
};

// Sums over the whitened curve of the products of the columns of its Jacobian and its residuals: all that least squares
// needs of the curve at one place. Whitens on the way, in one pass.
class Gram {
 public:
  Gram(const Columns& columns, std::span<const double> noise);

  std::size_t unknowns() const { return unknowns_; }
  double squares() const { return at(unknowns_, unknowns_); }
  double gradient(std::size_t unknown) const { return at(unknowns_, unknown); }

  // A problem of as few residuals as unknowns and one, with the same sums (Cholesky): Jacobian column by column. The
  // unknown `held` has no column.
  struct Few {
    std::size_t columns = 0;
    std::array<double, kMostUnknowns*(kMostUnknowns + 1)> jacobian{};
    std::array<double, kMostUnknowns + 1> residuals{};
  };
  Few few(std::optional<std::size_t> held) const;

  // Sum of squares of the column's part that is independent of the other columns. 0 if it has none.
  double own(std::size_t unknown) const;

  // Step of all unknowns to where the sum of squares, least over the others and linearised here, is `squares`; of the
  // two such places that on the `side`, -1 or 1. Empty if there is none.
  std::optional<std::array<double, kMostUnknowns>> step_to(double squares, std::size_t unknown, double side) const;

 private:
  using Matrix = std::array<std::array<double, kMostUnknowns + 1>, kMostUnknowns + 1>;

  template <std::size_t count>
  void add(const Columns& columns, std::span<const double> noise, std::size_t begin, std::size_t end);
  double at(std::size_t row, std::size_t column) const { return products_[row][column]; }
  void put(std::size_t row, std::size_t column, double value);

  struct Eliminated {
    std::array<std::size_t, kMostUnknowns + 1> order{};  // indices of the other unknowns, this one, the residuals
    Matrix rows{};                                       // remainders after elimination, up to the diagonal
  };
  std::optional<Eliminated> without_others(std::size_t unknown) const;

  std::size_t unknowns_;
  Matrix products_{};  // sums of products, with the residuals last
};

}  // namespace afm::fits
