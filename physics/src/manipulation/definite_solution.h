// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace afm::physics {

// Solves stiffness * step = -gradient for a symmetric positive definite matrix (Cholesky), which it overwrites. False
// if it is not. Column by column, so that what is zero is skipped: bodies that do not touch have no common entry.
template <class Matrix, class Vector>
bool solve_definite(std::size_t size, Matrix& stiffness, const Vector& gradient, Vector& step) noexcept {
  std::array<double, std::tuple_size_v<Matrix>> column;     // entries of a column below the diagonal, without zeros
  std::array<std::size_t, std::tuple_size_v<Matrix>> rows;  // rows of these entries
  for (std::size_t k = 0; k < size; ++k) {
    if (!(stiffness[k][k] > 0.0)) return false;
    const double pivot = stiffness[k][k] = std::sqrt(stiffness[k][k]);
    std::size_t count = 0;
    for (std::size_t i = k + 1; i < size; ++i) {
      if (stiffness[i][k] == 0.0) continue;
      column[count] = stiffness[i][k] = stiffness[i][k] / pivot;
      rows[count++] = i;
    }
    for (std::size_t a = 0; a < count; ++a) {
      double* const row = stiffness[rows[a]].data();
      for (std::size_t b = 0; b <= a; ++b) row[rows[b]] -= column[a] * column[b];
    }
  }
  for (std::size_t i = 0; i < size; ++i) {
    double value = -gradient[i];
    for (std::size_t k = 0; k < i; ++k) value -= stiffness[i][k] * step[k];
    step[i] = value / stiffness[i][i];
  }
  for (std::size_t i = size; i-- > 0;) {
    double value = step[i];
    for (std::size_t k = i + 1; k < size; ++k) value -= stiffness[k][i] * step[k];
    step[i] = value / stiffness[i][i];
  }
  return true;
}

}  // namespace afm::physics
