// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "study/threshold.h"

namespace afm::study {

// P(answers "second") of the observer that study/threshold.h fits, with lapses.
inline double answers_second_probability(const ThresholdTrial& trial, double weber_fraction, double exponent,
                                         double bias) {
  constexpr double kThresholdZ = 0.6744897501960817;  // z(0.75)
  const double signal = kThresholdZ * std::pow(trial.level / weber_fraction, exponent);
  const double z = (trial.second_stronger ? signal : -signal) - bias / std::numbers::sqrt2;
  return 0.5 * kLapseRate + (1.0 - kLapseRate) * 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

}  // namespace afm::study
