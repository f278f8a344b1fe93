// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/interval.h"

namespace afm::study {

// Signal detection theory (Green & Swets 1966; Macmillan & Creelman 2005). Pure functions; any thread.

// d' for two intervals, one of which is stronger: sqrt(2) z(proportion right). Infinite for 0 and 1.
double two_interval_d_prime(double right);

// Proportion right of an unbiased observer who picks the strongest of m: the integral over x of phi(x - d')
// Phi(x)^(m-1) (Macmillan & Creelman, ch. 7); and its inverse. m from 2 to 1000.
double choice_proportion(double d_prime, int alternatives);
double choice_d_prime(double right, int alternatives);

// d' for a number right of `trials`, with the exact interval of the proportion, which the monotone function preserves.
Estimate two_interval_estimate(std::size_t right, std::size_t trials);
Estimate choice_estimate(std::size_t right, std::size_t trials, int alternatives);

struct YesNoCounts {
  std::size_t hits = 0, signals = 0, false_alarms = 0, noises = 0;
};
enum class RateCorrection {
  None,      // rates without correction; infinite for 0 and 1
  LogLinear  // rates (count + 1/2)/(trials + 1) (Hautus 1995)
};
struct YesNo {
  double d_prime = kNoValue;    // d' = z(hit rate) - z(false alarm rate)
  double criterion = kNoValue;  // c = -(z(hit rate) + z(false alarm rate))/2; above 0: too few "yes"
  // intervals from the variances of both rates (Gourevitch & Galanter 1967)
  Interval d_prime_interval{}, criterion_interval{};
};
YesNo yes_no(const YesNoCounts& counts, RateCorrection correction);

// Number of each response to each stimulus, both in the same order.
struct ConfusionMatrix {
  std::vector<std::string> names;
  std::vector<std::vector<std::size_t>> counts;  // number of trials, counts[shown][answered]

  std::size_t trials() const;
  std::size_t right() const;
  double accuracy() const;
  // Cohen's kappa (1960): (observed agreement - chance agreement)/(1 - chance agreement)
  double kappa() const;
  // information about the stimuli in the answers, in bits (Miller & Nicely 1955)
  double information_bits() const;
  // counts for one stimulus against all other stimuli shown
  YesNoCounts against_the_rest(std::size_t name) const;
};

}  // namespace afm::study
