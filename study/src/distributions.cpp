// SPDX-License-Identifier: Apache-2.0
#include "distributions.h"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace afm::study {

namespace {

namespace bm = boost::math;
namespace bp = boost::math::policies;

// double throughout, for the same bits on every machine; errno instead of exceptions
using Quiet = bp::policy<bp::domain_error<bp::errno_on_error>, bp::pole_error<bp::errno_on_error>,
                         bp::overflow_error<bp::errno_on_error>, bp::evaluation_error<bp::errno_on_error>,
                         bp::promote_double<false>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

bool is_probability(double p) { return p >= 0.0 && p <= 1.0; }

}  // namespace

double normal_density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double normal_quantile(double probability) {
  if (!is_probability(probability)) return kNothing;
  if (probability == 0.0 || probability == 1.0) return probability == 0.0 ? -kInfinity : kInfinity;
  return bm::quantile(bm::normal_distribution<double, Quiet>(), probability);
}

double student_cdf(double t, double degrees) {
  if (std::isnan(t) || !(degrees > 0.0)) return kNothing;
  if (std::isinf(t)) return t < 0.0 ? 0.0 : 1.0;
  return bm::cdf(bm::students_t_distribution<double, Quiet>(degrees), t);
}

double student_quantile(double probability, double degrees) {
  if (!is_probability(probability) || !(degrees > 0.0)) return kNothing;
  if (probability == 0.0 || probability == 1.0) return probability == 0.0 ? -kInfinity : kInfinity;
  return bm::quantile(bm::students_t_distribution<double, Quiet>(degrees), probability);
}

double noncentral_student_cdf(double t, double degrees, double noncentrality) {
  if (!std::isfinite(t) || !(degrees > 0.0) || !std::isfinite(noncentrality)) return kNothing;
  return bm::cdf(bm::non_central_t_distribution<double, Quiet>(degrees, noncentrality), t);
}

double beta_quantile(double probability, double a, double b) {
  if (!is_probability(probability) || !(a > 0.0) || !(b > 0.0)) return kNothing;
  return bm::quantile(bm::beta_distribution<double, Quiet>(a, b), probability);
}

double beta_cdf(double x, double a, double b) {
  if (!is_probability(x) || !(a > 0.0) || !(b > 0.0)) return kNothing;
  return bm::cdf(bm::beta_distribution<double, Quiet>(a, b), x);
}

double two_sided_p(double t, double degrees) {
  // the smaller tail preserves the digits of a small p
  return 2.0 * student_cdf(-std::abs(t), degrees);
}

}  // namespace afm::study
