// SPDX-License-Identifier: Apache-2.0
#include "study/means.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "distributions.h"

namespace afm::study {

namespace {

constexpr double kInterval = 1.0 - 0.5 * kIntervalAlpha;

double squared(double x) { return x * x; }

// The noncentrality for which t is the quantile `probability`.
double noncentrality_of(double t, double degrees, double probability) {
  // wide enough for both tails at any number of degrees of freedom
  const double reach = 10.0 + 10.0 * std::abs(t);
  double low = t - reach, high = t + reach;
  for (int step = 0; step < 100 && high - low > 1e-12 * reach; ++step) {
    const double middle = 0.5 * (low + high);
    // decreases with the noncentrality
    (noncentral_student_cdf(t, degrees, middle) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Summary summary_of(std::span<const double> values) {
  Summary summary{.n = values.size()};
  if (values.empty()) return summary;
  const auto n = static_cast<double>(values.size());
  summary.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() < 2) return summary;
  double squares = 0.0;
  for (const double value : values) squares += squared(value - summary.mean);
  summary.sd = std::sqrt(squares / (n - 1.0));
  return summary;
}

Interval t_interval(const Summary& summary) {
  if (summary.n < 2) return {};
  const auto n = static_cast<double>(summary.n);
  const double half = student_quantile(kInterval, n - 1.0) * summary.sd / std::sqrt(n);
  return {summary.mean - half, summary.mean + half};
}

Estimate mean_estimate(std::span<const double> values, const Interval& scale) {
  const Summary summary = summary_of(values);
  return {summary.n, summary.mean, t_interval(summary).within(scale)};
}

Interval standardised_interval(double t, double degrees, double scale) {
  // beyond, the noncentral t is numerically inaccurate
  constexpr double kLargestT = 1e3;
  if (!(std::abs(t) < kLargestT) || !(degrees > 0.0)) return {};
  return {noncentrality_of(t, degrees, kInterval) / scale, noncentrality_of(t, degrees, 1.0 - kInterval) / scale};
}

TTest welch_test(const Summary& a, const Summary& b) {
  TTest test;
  test.d.n = a.n + b.n;
  if (a.n < 2 || b.n < 2) return test;
  const auto na = static_cast<double>(a.n), nb = static_cast<double>(b.n);
  const double va = squared(a.sd) / na, vb = squared(b.sd) / nb;
  if (!(va + vb > 0.0)) return test;
  test.t = (a.mean - b.mean) / std::sqrt(va + vb);
  test.degrees = squared(va + vb) / (squared(va) / (na - 1.0) + squared(vb) / (nb - 1.0));
  test.p = two_sided_p(test.t, test.degrees);
  const double pooled = std::sqrt(((na - 1.0) * squared(a.sd) + (nb - 1.0) * squared(b.sd)) / (na + nb - 2.0));
  test.d.value = (a.mean - b.mean) / pooled;
  const double scale = std::sqrt(na * nb / (na + nb));
  test.d.interval = standardised_interval(test.d.value * scale, na + nb - 2.0, scale);
  return test;
}

TTest paired_test(std::span<const double> differences) {
  const Summary summary = summary_of(differences);
  TTest test;
  test.d.n = summary.n;
  if (summary.n < 2 || !(summary.sd > 0.0)) return test;
  const double root = std::sqrt(static_cast<double>(summary.n));
  test.d.value = summary.mean / summary.sd;
  test.t = test.d.value * root;
  test.degrees = static_cast<double>(summary.n) - 1.0;
  test.p = two_sided_p(test.t, test.degrees);
  test.d.interval = standardised_interval(test.t, test.degrees, root);
  return test;
}

std::vector<double> holm_adjusted(std::span<const double> p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!std::isnan(p[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.begin(), p.end());
  double largest = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    largest = std::max(largest, std::min(1.0, p[order[i]] * static_cast<double>(order.size() - i)));
    adjusted[order[i]] = largest;
  }
  return adjusted;
}

void correct_by_holm(std::span<TestResult* const> tests) {
  std::vector<double> p;
  for (const TestResult* test : tests) p.push_back(test->p);
  if (std::count_if(p.begin(), p.end(), [](double each) { return !std::isnan(each); }) < 2) return;
  const std::vector<double> adjusted = holm_adjusted(p);
  for (std::size_t i = 0; i < tests.size(); ++i) tests[i]->holm_p = adjusted[i];
}

double normalised_gain(double pre, double post) { return pre < 1.0 ? (post - pre) / (1.0 - pre) : kNoValue; }

double cronbach_alpha(const std::vector<std::vector<double>>& people) {
  if (people.size() < 2 || people.front().size() < 2) return kNoValue;
  const std::size_t items = people.front().size();
  double of_items = 0.0;
  for (std::size_t item = 0; item < items; ++item) {
    std::vector<double> column;
    column.reserve(people.size());
    for (const auto& person : people) column.push_back(person.at(item));
    of_items += squared(summary_of(column).sd);
  }
  std::vector<double> sums;
  sums.reserve(people.size());
  for (const auto& person : people) sums.push_back(std::accumulate(person.begin(), person.end(), 0.0));
  const double of_sums = squared(summary_of(sums).sd);
  const auto k = static_cast<double>(items);
  return of_sums > 0.0 ? k / (k - 1.0) * (1.0 - of_items / of_sums) : kNoValue;
}

}  // namespace afm::study
