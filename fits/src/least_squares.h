// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace afm::fits {

// Least squares by Levenberg and Marquardt: MINPACK's lmder, which scipy and lmfit call "leastsq". `evaluate` fills the
// one that is not empty: the residuals, or the Jacobian, column by column. Changes `parameters` to the minimum. Returns
// the sum of squares there; not finite if there is no minimum. Ends once a step reduces the squares by less than the
// share `reduction`.
using Residuals =
    std::function<void(std::span<const double> parameters, std::span<double> residuals, std::span<double> jacobian)>;

inline constexpr double kWholeReduction = 1e-10;
double least_squares(const Residuals& evaluate, std::size_t residual_count, std::vector<double>& parameters,
                     double reduction = kWholeReduction);

}  // namespace afm::fits
