// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "correlated_noise.h"
#include "lagged_products.h"

namespace afm::fits {

using Orders = std::array<double, kMostNoiseOrder>;
using OrderMatrix = std::array<Orders, kMostNoiseOrder>;

// Twice the negative restricted log-likelihood of autoregressive noise with these coefficients, up to a constant.
// Infinite where the columns of the fit are not independent.
double deviance(const LaggedProducts& products, const Orders& coefficients, std::size_t order);

// Deviance with its derivatives by the coefficients.
struct Deviance {
  double value = 0;
  Orders gradient{};
  OrderMatrix curvature{};
  OrderMatrix rounder{};  // curvature without terms that may be negative; close to a minimum about the same
};
Deviance deviance_with_slopes(const LaggedProducts& products, const Orders& coefficients, std::size_t order);

}  // namespace afm::fits
