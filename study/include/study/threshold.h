// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "study/interval.h"

namespace afm::study {

// A trial of two intervals, one of which holds the stronger stimulus: (1 + level) times the other.
struct ThresholdTrial {
  double level = 0;  // level w, 0 or more
  bool second_stronger = false;
  bool answered_second = false;

  bool right() const { return second_stronger == answered_second; }
};

// Share of inattentive answers assumed by the fit, as in QUEST (Watson & Pelli 1983).
inline constexpr double kLapseRate = 0.01;

// Parameters of an observer whose d' grows as a power of the level (Pelli 1987) and who prefers an interval:
// P(answers "second") = Phi(-+ z(0.75) (w/W)^b - bias/sqrt(2)), + if the second is stronger. W, the Weber fraction, is
// the level at which an observer without preference is right in 75 % of the trials: d' = sqrt(2) z(0.75) = 0.954. b = 1
// by Weber's law and signal detection theory. The bias, in units of d', is above 0 for a preference of "first".
struct ThresholdFit {
  Estimate weber_fraction{};  // estimate of W; its ends are 0 or infinite if the trials do not bound them
  Estimate bias{};
  std::size_t right = 0;
};

// Medians and quantiles of the posterior distribution of W, b and the bias (Kuss, Jaekel & Wichmann 2005), with a prior
// that is flat in log W from an eighth of the lowest level to eight times the highest, normal in log b (1.4, SD 0.6)
// and in the bias (0, SD sqrt(2)). For 40 trials of simulated observers with b from 1 to 2.8 the intervals contain the
// true value in 92 to 96 of 100 cases; those of the likelihood's profile in 88 to 92. Fewer than 5 trials, or none
// above level 0, give no values.
ThresholdFit fitted_threshold(std::span<const ThresholdTrial> trials);

}  // namespace afm::study
