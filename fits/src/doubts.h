// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "curve_problem.h"
#include "fits/elastic_fit.h"
#include "profile.h"

namespace afm::fits {

inline constexpr std::size_t kFewest = 10;  // smallest number of points of a fit
inline constexpr double kRounding =
    1e-6;  // share of the push below which residuals are rounding errors without information on the shape

// Level and tilt at a sample.
double baseline_n(const ElasticFit& fit, const Sample& sample, const Sample& first);

// Fills the doubts of a fit, whose other members are known, its verdict, and the modulus of half the depth.
void judge(std::span<const Sample> samples, const FitSetup& setup, const CurveProblem& problem, const Ended& ended,
           ElasticFit& fit);

}  // namespace afm::fits
