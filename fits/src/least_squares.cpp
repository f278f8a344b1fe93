// SPDX-License-Identifier: Apache-2.0
#include "least_squares.h"

#include <cminpack.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace afm::fits {

namespace {

int residuals_or_jacobian(void* evaluate, int residual_count, int parameter_count, const double* parameters,
                          double* residuals, double* jacobian, int /*leading*/, int wanted) {
  const auto m = static_cast<std::size_t>(residual_count), n = static_cast<std::size_t>(parameter_count);
  constexpr int kResiduals = 1;
  const auto& function = *static_cast<const Residuals*>(evaluate);
  if (wanted == kResiduals) {
    function({parameters, n}, {residuals, m}, {});
  } else {
    function({parameters, n}, {}, {jacobian, m * n});
  }
  return 0;
}

}  // namespace

double least_squares(const Residuals& evaluate, std::size_t residual_count, std::vector<double>& parameters,
                     double reduction) {
  constexpr double kStep = 1e-9, kFactor = 1.0;
  constexpr int kMostEvaluations = 60, kOwnScales = 1;
  const std::size_t n = parameters.size(), m = residual_count;
  if (m < n) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> residuals(m), jacobian(m * n), diagonal(n), qtf(n), a(n), b(n), c(n), d(m);
  std::vector<int> pivots(n);
  int evaluations = 0, jacobians = 0;
  Residuals function = evaluate;
  const int end = lmder(residuals_or_jacobian, &function, static_cast<int>(m), static_cast<int>(n), parameters.data(),
                        residuals.data(), jacobian.data(), static_cast<int>(m), reduction, kStep, 0.0, kMostEvaluations,
                        diagonal.data(), kOwnScales, kFactor, 0, &evaluations, &jacobians, pivots.data(), qtf.data(),
                        a.data(), b.data(), c.data(), d.data());
  // 0: wrong arguments. 5, too many evaluations, is a minimum but for its last digits: samples that enter the contact
  // make kinks
  if (end <= 0) return std::numeric_limits<double>::quiet_NaN();
  return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
}

}  // namespace afm::fits
