// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::study {

// Distribution functions of Boost.Math. Total: an undefined value is NaN, and only std::bad_alloc can be thrown.

double normal_density(double z);
double normal_cdf(double z);
// quantile of the normal distribution, -infinity at 0, infinity at 1
double normal_quantile(double probability);

// P(T <= t) and its inverse, Student's t; degrees of freedom above 0, not necessarily integer.
double student_cdf(double t, double degrees);
double student_quantile(double probability, double degrees);
double noncentral_student_cdf(double t, double degrees, double noncentrality);

// The inverse of the regularised incomplete beta function I_x(a, b).
double beta_quantile(double probability, double a, double b);
double beta_cdf(double x, double a, double b);

// The two-sided p of a statistic that follows Student's t under the null hypothesis.
double two_sided_p(double t, double degrees);

}  // namespace afm::study
