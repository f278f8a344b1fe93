// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace afm::curves {

// Statistics of moduli that a few outliers hardly change, and the mean of a log-normal sample.
struct ModulusFigures {
  double median_pa = 0;
  double deviation_pa = 0;  // 1.4826 times the median distance from the median: a normal sample's standard deviation
  double geometric_mean_pa = 0;
};

// Figures of at least one modulus above zero.
ModulusFigures modulus_figures(std::vector<double> moduli_pa);

// Histograms of the moduli, a linear one and one of their logarithms, as an SVG file; the median is marked. The linear
// one ends at the 1st and the 99th percentile. For moduli above zero, at least one.
std::string modulus_histograms(std::vector<double> moduli_pa);

}  // namespace afm::curves
