// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "curve_problem.h"

namespace afm::fits {

inline constexpr double kChiSquare95 = 3.841458820694124;  // 95 % quantile for one degree of freedom

// A fit that has ended: unknowns, noise, and the sum of the whitened squares.
struct Ended {
  Unknowns unknowns;
  std::vector<double> noise;
  bool filtered = false;  // true: noise coefficients were found and used
  double squares = std::numeric_limits<double>::infinity();
};

// False for values that no minimum can have.
bool is_usable(const Unknowns& unknowns, double squares);

// Standard deviation of an unknown, from the whitened Jacobian: where the profile begins.
double deviation_of(std::size_t unknown, const CurveProblem& problem, const Ended& ended);

// End of the interval of an unknown on one side: where the likelihood, maximised over the other unknowns, has fallen by
// half the 95 % quantile of chi square.
struct ProfileEnd {
  double value = 0;               // value at the end; infinite if there is none
  std::optional<Unknowns> lower;  // better minimum found on the way; empty: none
};
// `side` is -1 or 1; `deviation` as above.
ProfileEnd profile_end(std::size_t unknown, const CurveProblem& problem, const Ended& ended, double deviation,
                       double side);

}  // namespace afm::fits
