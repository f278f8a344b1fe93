// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace afm::fits {

inline constexpr std::size_t kMostNoiseOrder = 4;

// Coefficients of autoregressive noise, r_t = sum_j c_j r_(t-j) + white, in the residuals of a least squares fit, by
// restricted maximum likelihood on the linearised fit (Patterson & Thompson 1971): from the residuals only they would
// be too small, since the fit has removed a part. Order 0 to kMostNoiseOrder by Akaike's criterion. `jacobian`: column
// by column.
std::vector<double> noise_coefficients(std::span<const double> residuals, std::span<const double> jacobian);

// Replaces the values by values_t - sum_j c_j values_(t-j), the first ones dropped. Returns the number of values left.
std::size_t whiten(std::span<const double> coefficients, std::span<double> values);

// Probability that signs in random order have as few runs, or fewer (Wald & Wolfowitz 1940, normal approximation):
// signs before `split` and from it on, each around its own median. 1 if both are too short.
double runs_probability(std::span<const double> residuals, std::size_t split = 0);

}  // namespace afm::fits
