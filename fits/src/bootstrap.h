// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "fits/elastic_fit.h"

namespace afm::fits {

// Intervals by a bootstrap of moving blocks (Kuensch, Ann. Stat. 17, 1217 (1989)): blocks of residuals from random
// places, five correlation times long, are added to the model, and the fit is repeated with its noise, starting from
// its result, `setup.bootstraps` times; the intervals lie between the quantiles 0.025 and 0.975. The same samples give
// the same intervals. Empty if fewer than half of the fits converge.
std::optional<Bootstrap> bootstrap_of(std::span<const Sample> samples, const FitSetup& setup, const ElasticFit& fit);

}  // namespace afm::fits
