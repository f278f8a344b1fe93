// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "physics/rows_of_enum.h"

namespace afm::fits {

// Inputs of a fit that may be wrong.
enum class Given {
  SpringConstant,  // scale factor of all forces
  Sensitivity,     // optical lever's sensitivity s; the spring constant is from a thermal tune with it, k ~ 1/s^2
  Radius,
  HalfAngle,
  Layer,
  Poisson
};

struct GivenName {
  Given given;
  std::string_view name;
};
inline constexpr std::array kGiven{GivenName{Given::SpringConstant, "spring-constant"},
                                   GivenName{Given::Sensitivity, "sensitivity"},
                                   GivenName{Given::Radius, "radius"},
                                   GivenName{Given::HalfAngle, "half-angle"},
                                   GivenName{Given::Layer, "layer"},
                                   GivenName{Given::Poisson, "poisson"}};
static_assert(physics::has_row_for_each(kGiven, &GivenName::given));

// Relative standard deviation.
struct Uncertainty {
  Given of = Given::SpringConstant;
  double share = 0;
};

// Share of a result's relative deviation, to first order: `relative` is the input's, `logarithms` are those of the
// result where the input is multiplied by either of `factors`.
double error_share(double relative, const std::array<double, 2>& factors, const std::array<double, 2>& logarithms);

// Relative deviation by independent shares, which add in quadrature.
double sum_of_shares(std::span<const double> shares);

// First-order effect on the results: relative standard deviations. The noise has its own interval.
struct Systematic {
  Uncertainty uncertainty;
  double modulus_share = 0;
  double work_share = 0;  // relative deviation of the work of adhesion; 0 without it
};

// Relative standard deviations of the results by all uncertainties; 0 without any, not a number where a share is none.
struct SystematicShares {
  double modulus = 0, work = 0;
};
SystematicShares sum_of_shares(std::span<const Systematic> systematic);

}  // namespace afm::fits
