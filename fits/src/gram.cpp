// SPDX-License-Identifier: Apache-2.0
#include "gram.h"

#include <algorithm>
#include <cmath>

#include "lanes.h"

namespace afm::fits {

namespace {

// Share of a column's square below which rounding alone is left of it.
constexpr double kNothingLeft = 1e-14;

}  // namespace

Gram::Gram(const Columns& columns, std::span<const double> noise) : unknowns_(columns.count) {
  const std::size_t begin = noise.size(), middle = std::clamp(columns.late, begin, columns.size);
  const auto sum = [&](std::size_t count, std::size_t from, std::size_t to) {
    if (count == 1) add<1>(columns, noise, from, to);
    if (count == 2) add<2>(columns, noise, from, to);
    if (count == 3) add<3>(columns, noise, from, to);
    if (count == 4) add<4>(columns, noise, from, to);
    if (count == 5) add<5>(columns, noise, from, to);
  };
  sum(columns.dense, begin, middle);
  sum(columns.count, middle, columns.size);
  double level = 1.0;
  for (const double coefficient : noise) level -= coefficient;
  products_[columns.level][columns.level] = level * level * static_cast<double>(columns.size - begin);
}

void Gram::put(std::size_t row, std::size_t column, double value) {
  products_[row][column] += value;
  if (row != column) products_[column][row] += value;
}

template <std::size_t count>
void Gram::add(const Columns& columns, std::span<const double> noise, std::size_t begin, std::size_t end) {
  std::array<Two, count> row{}, sums{};
  std::array<Two, count*(count + 1) / 2> products{};
  const auto add_row = [&] {
    unrolled<count>([&](auto a) {
      sums[a] += row[a];
      unrolled<a + 1>([&](auto b) { products[a * (a + 1) / 2 + b] += row[a] * row[b]; });
    });
  };
  std::size_t t = begin;
  for (; t + 2 <= end; t += 2) {
    unrolled<count>([&](auto k) { row[k] = two_at(columns.values[k] + t); });
    for (std::size_t j = 0; j < noise.size(); ++j) {
      unrolled<count>([&](auto k) { row[k] -= noise[j] * two_at(columns.values[k] + t - 1 - j); });
    }
    add_row();
  }
  if (t < end) {
    unrolled<count>([&](auto k) {
      double last = columns.values[k][t];
      for (std::size_t j = 0; j < noise.size(); ++j) last -= noise[j] * columns.values[k][t - 1 - j];
      row[k] = Two{last, 0.0};
    });
    add_row();
  }
  double level = 1.0;
  for (const double coefficient : noise) level -= coefficient;
  unrolled<count>([&](auto a) {
    put(columns.unknowns[a], columns.level, level * sum_of(sums[a]));
    unrolled<a + 1>(
        [&](auto b) { put(columns.unknowns[a], columns.unknowns[b], sum_of(products[a * (a + 1) / 2 + b])); });
  });
}

// Jacobian of few rows: the transpose of the Cholesky factor L; a column that depends on those before gets none.
Gram::Few Gram::few(std::optional<std::size_t> held) const {
  std::array<std::size_t, kMostUnknowns> freed{};
  Few found;
  for (std::size_t c = 0; c < unknowns_; ++c) {
    if (c != held) freed[found.columns++] = c;
  }
  const std::size_t n = found.columns, rows = n + 1;
  double left = squares();
  // row by row of the transpose: what the rows before leave of each product
  for (std::size_t i = 0; i < n; ++i) {
    double* const own_column = &found.jacobian[i * rows];
    double own = at(freed[i], freed[i]);
    for (std::size_t k = 0; k < i; ++k) own -= own_column[k] * own_column[k];
    if (!(own > kNothingLeft * at(freed[i], freed[i]))) continue;
    own_column[i] = std::sqrt(own);
    for (std::size_t c = i + 1; c < n; ++c) {
      double* const column = &found.jacobian[c * rows];
      double shared = at(freed[i], freed[c]);
      for (std::size_t k = 0; k < i; ++k) shared -= own_column[k] * column[k];
      column[i] = shared / own_column[i];
    }
    double gradient_left = gradient(freed[i]);
    for (std::size_t k = 0; k < i; ++k) gradient_left -= own_column[k] * found.residuals[k];
    found.residuals[i] = gradient_left / own_column[i];
    left -= found.residuals[i] * found.residuals[i];
  }
  found.residuals[n] = std::sqrt(left < 0.0 ? 0.0 : left);
  return found;
}

std::optional<Gram::Eliminated> Gram::without_others(std::size_t unknown) const {
  Eliminated found;
  std::size_t others = 0;
  for (std::size_t c = 0; c < unknowns_; ++c) {
    if (c != unknown) found.order[others++] = c;
  }
  found.order[others] = unknown;
  found.order[others + 1] = unknowns_;
  for (std::size_t a = 0; a <= unknowns_; ++a) {
    for (std::size_t b = 0; b <= a; ++b) found.rows[a][b] = at(found.order[a], found.order[b]);
  }
  for (std::size_t p = 0; p < others; ++p) {
    const double pivot = found.rows[p][p];
    if (!(pivot > kNothingLeft * at(found.order[p], found.order[p]))) return std::nullopt;
    for (std::size_t a = p + 1; a <= unknowns_; ++a) {
      const double factor = found.rows[a][p] / pivot;
      for (std::size_t b = p + 1; b <= a; ++b) found.rows[a][b] -= factor * found.rows[b][p];
    }
  }
  if (!(found.rows[others][others] > kNothingLeft * at(unknown, unknown))) return std::nullopt;
  return found;
}

double Gram::own(std::size_t unknown) const {
  const auto left = without_others(unknown);
  return left ? left->rows[unknowns_ - 1][unknowns_ - 1] : 0.0;
}

std::optional<std::array<double, kMostUnknowns>> Gram::step_to(double squares, std::size_t unknown, double side) const {
  const auto left = without_others(unknown);
  if (!left) return std::nullopt;
  const auto& rows = left->rows;
  const std::size_t last = unknowns_ - 1;
  // least over the others: rest + 2 slope x + own x^2
  const double own = rows[last][last], slope = rows[unknowns_][last], rest = rows[unknowns_][unknowns_];
  const double root = slope * slope - own * (rest - squares);
  if (!(root >= 0.0)) return std::nullopt;
  std::array<double, kMostUnknowns> by_order{}, step{};
  by_order[last] = (side * std::sqrt(root) - slope) / own;
  for (std::size_t p = last; p-- > 0;) {
    double sum = rows[unknowns_][p];
    for (std::size_t q = p + 1; q <= last; ++q) sum += rows[q][p] * by_order[q];
    by_order[p] = -sum / rows[p][p];
  }
  for (std::size_t p = 0; p <= last; ++p) step[left->order[p]] = by_order[p];
  return step;
}

}  // namespace afm::fits
