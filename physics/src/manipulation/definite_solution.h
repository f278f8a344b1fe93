// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

namespace afm::physics {

// Solves stiffness * step = -gradient for a symmetric positive definite matrix (Cholesky), which it overwrites. False
// if it is not.
template <class Matrix, class Vector>
bool solve_definite(std::size_t size, Matrix& stiffness, const Vector& gradient, Vector& step) noexcept {
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double value = stiffness[i][j];
      for (std::size_t k = 0; k < j; ++k) value -= stiffness[i][k] * stiffness[j][k];
      if (i == j) {
        if (!(value > 0.0)) return false;
        stiffness[i][i] = std::sqrt(value);
      } else {
        stiffness[i][j] = value / stiffness[j][j];
      }
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
