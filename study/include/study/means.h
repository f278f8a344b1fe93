// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "study/interval.h"

namespace afm::study {

// Means and their comparison. Pure functions; any thread. NaN if there are too few values or no spread.

struct Summary {
  std::size_t n = 0;
  double mean = kNoValue;
  double sd = kNoValue;  // sample standard deviation, with the divisor n-1
};
Summary summary_of(std::span<const double> values);

// mean -+ t(0.975, n-1) SD/sqrt(n) (Student 1908).
Interval t_interval(const Summary& summary);
// Mean of values on a bounded scale, which also bounds the mean.
Estimate mean_estimate(std::span<const double> values, const Interval& scale = {-kUnbounded, kUnbounded});

// Comparison of two means, from different people with unequal variances or from the same people.
struct TTest {
  double t = kNoValue;
  double degrees = kNoValue;
  double p = kNoValue;  // two-sided p value
  Estimate d;           // Cohen's d, or d_z of paired differences
};

// Welch 1947 with the degrees of freedom of Welch and Satterthwaite. d = (mean a - mean b)/pooled SD (Cohen 1988), its
// interval by inverting the noncentral t of n_a + n_b - 2 degrees of freedom (Cumming & Finch 2001).
TTest welch_test(const Summary& a, const Summary& b);

// Paired test of differences: d_z = mean/SD, t = d_z sqrt(n); interval by inverting the noncentral t of n-1 degrees.
TTest paired_test(std::span<const double> differences);

// Interval of d = t/scale, where t is noncentral t with `degrees` and noncentrality d scale.
Interval standardised_interval(double t, double degrees, double scale);

// p times the number of comparisons not yet rejected, in order of p (Holm 1979); NaN stays.
std::vector<double> holm_adjusted(std::span<const double> p);

// Corrects tests that are reported side by side for their number; leaves a single one unchanged.
void correct_by_holm(std::span<TestResult* const> tests);

// (post - pre)/(1 - pre) of proportions (Hake 1998); NaN for a pre of 1.
double normalised_gain(double pre, double post);

// Cronbach 1951: rows are people, columns items; k/(k-1) (1 - sum of the items' variances/variance of the sums).
double cronbach_alpha(const std::vector<std::vector<double>>& people);

}  // namespace afm::study
