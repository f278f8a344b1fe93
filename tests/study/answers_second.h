// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "study/threshold.h"

namespace afm::study {

// Probability that the observer fitted by study/threshold.h, with lapses, answers "second".
inline double answers_second_probability(const ThresholdTrial& trial, double weber_fraction, double exponent,
                                         double bias) {
  constexpr double kThresholdZ = 0.6744897501960817;  // z(0.75)
  const double signal = kThresholdZ * std::pow(trial.level / weber_fraction, exponent);
  const double z = (trial.second_stronger ? signal : -signal) - bias / std::numbers::sqrt2;
  return 0.5 * kLapseRate + (1.0 - kLapseRate) * 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

}  // namespace afm::study
