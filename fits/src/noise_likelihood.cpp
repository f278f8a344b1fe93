// SPDX-License-Identifier: Apache-2.0
#include "noise_likelihood.h"

#include <cmath>
#include <limits>
#include <span>

namespace afm::fits {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr std::size_t kMost = LaggedProducts::kMostColumns;

using Vector = std::array<double, kMost>;
using Matrix = std::array<Vector, kMost>;

Matrix square_of(const LaggedProducts::Triangle& triangle, std::size_t size) {
  Matrix matrix{};
  for (std::size_t a = 0, entry = 0; a < size; ++a) {
    for (std::size_t b = 0; b <= a; ++b, ++entry) matrix[a][b] = matrix[b][a] = triangle[entry];
  }
  return matrix;
}

std::array<double, kLags> filter_of(const Orders& coefficients, std::size_t order) {
  std::array<double, kLags> filter{1.0};
  for (std::size_t j = 0; j < order; ++j) filter[j + 1] = -coefficients[j];
  return filter;
}

Vector product(const Matrix& matrix, const Vector& vector, std::size_t size) {
  Vector result{};
  for (std::size_t a = 0; a < size; ++a) {
    for (std::size_t b = 0; b < size; ++b) result[a] += matrix[a][b] * vector[b];
  }
  return result;
}

double dot(const Vector& a, const Vector& b, std::size_t size) {
  double sum = 0.0;
  for (std::size_t i = 0; i < size; ++i) sum += a[i] * b[i];
  return sum;
}

// Eliminates the columns of the fit, from the last to the first after the residuals: with them the inverse of their
// products, what is left of the residuals' square, and the determinant. By Gauss and Jordan.
struct Eliminated {
  Matrix inverse{};  // inverse matrix, with zeros in the row and column of the residuals
  double determinant = 1.0;
};
bool eliminate(const Matrix& products, std::size_t size, Eliminated& result) {
  Matrix left(products);
  for (std::size_t i = 1; i < size; ++i) result.inverse[i][i] = 1.0;
  for (std::size_t pivot = 1; pivot < size; ++pivot) {
    const double p = left[pivot][pivot];
    if (!(p > 0.0)) return false;
    result.determinant *= p;
    for (std::size_t b = 1; b < size; ++b) {
      left[pivot][b] /= p;
      result.inverse[pivot][b] /= p;
    }
    for (std::size_t a = 1; a < size; ++a) {
      if (a == pivot) continue;
      const double factor = left[a][pivot];
      for (std::size_t b = 1; b < size; ++b) {
        left[a][b] -= factor * left[pivot][b];
        result.inverse[a][b] -= factor * result.inverse[pivot][b];
      }
    }
  }
  return true;
}

}  // namespace

double deviance(const LaggedProducts& products, const Orders& coefficients, std::size_t order) {
  const std::array<double, kLags> filter = filter_of(coefficients, order);
  LaggedProducts::Triangle triangle = products.whitened(std::span(filter).first(order + 1));
  // eliminates the columns of the fit one by one: what is left of the residual's square is the sum after the fit
  const auto row = [&triangle](std::size_t a) { return &triangle[a * (a + 1) / 2]; };
  double determinant = 1.0;
  for (std::size_t pivot = products.columns() - 1; pivot >= 1; --pivot) {
    const double* last = row(pivot);
    const double p = last[pivot];
    if (!(p > 0.0)) return kNone;
    determinant *= p;
    for (std::size_t a = 0; a < pivot; ++a) {
      const double factor = last[a] / p;
      double* here = row(a);
      for (std::size_t b = 0; b <= a; ++b) here[b] -= factor * last[b];
    }
  }
  const double free = products.count() - static_cast<double>(products.columns() - 1);
  return triangle.front() > 0.0 ? free * std::log(triangle.front()) + std::log(determinant) : kNone;
}

// With M the products of the whitened columns, M_r its part without the residuals, and v = (1, -M_r^-1 m) the residuals
// after the fit: D = n ln(v' M v) + ln det M_r.
Deviance deviance_with_slopes(const LaggedProducts& products, const Orders& coefficients, std::size_t order) {
  const std::size_t size = products.columns();
  const std::array<double, kLags> filter = filter_of(coefficients, order);
  const Matrix whitened = square_of(products.whitened(std::span(filter).first(order + 1)), size);
  Deviance found{.value = kNone};
  Eliminated without;
  if (!eliminate(whitened, size, without)) return found;
  Vector after = product(without.inverse, whitened[0], size);
  for (double& each : after) each = -each;
  after[0] = 1.0;
  const double squares = dot(whitened[0], after, size);
  if (!(squares > 0.0)) return found;
  const double free = products.count() - static_cast<double>(size - 1);
  found.value = free * std::log(squares) + std::log(without.determinant);

  std::array<Vector, kMostNoiseOrder> slope_after{}, moved{};  // M_l v, and M_r^-1 M_l v
  std::array<Matrix, kMostNoiseOrder> share{};                 // products M_r^-1 M_l
  Orders squares_slope{};
  for (std::size_t l = 0; l < order; ++l) {
    LaggedProducts::Triangle slope{};
    for (std::size_t j = 0; j <= order; ++j) {
      const double weight = (j == l + 1 ? -2.0 : -1.0) * filter[j];
      const LaggedProducts::Triangle& both = products.of(l + 1, j);
      for (std::size_t entry = 0; entry < products.entries(); ++entry) slope[entry] += weight * both[entry];
    }
    const Matrix matrix = square_of(slope, size);
    slope_after[l] = product(matrix, after, size);
    moved[l] = product(without.inverse, slope_after[l], size);
    squares_slope[l] = dot(after, slope_after[l], size);
    double trace = 0.0;
    for (std::size_t a = 1; a < size; ++a) {
      for (std::size_t b = 1; b < size; ++b) share[l][a][b] = dot(without.inverse[a], matrix[b], size);
      trace += share[l][a][a];
    }
    found.gradient[l] = free * squares_slope[l] / squares + trace;
  }
  for (std::size_t l = 0; l < order; ++l) {
    for (std::size_t m = 0; m <= l; ++m) {
      const Matrix both = square_of(products.of(l + 1, m + 1), size);
      const double twice = l == m ? 2.0 : 1.0;
      double trace = 0.0;
      for (std::size_t a = 1; a < size; ++a) {
        trace += twice * dot(without.inverse[a], both[a], size);
        for (std::size_t b = 1; b < size; ++b) trace -= share[l][a][b] * share[m][b][a];
      }
      const double bent = twice * dot(after, product(both, after, size), size);
      const double own = free * (bent - 2.0 * dot(slope_after[l], moved[m], size)) / squares;
      const double falling = free * squares_slope[l] * squares_slope[m] / (squares * squares);
      found.rounder[l][m] = found.rounder[m][l] = own;
      found.curvature[l][m] = found.curvature[m][l] = own - falling + trace;
    }
  }
  return found;
}

}  // namespace afm::fits
