// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "fits/elastic_fit.h"

namespace afm::fits {

// Effect of each of the setup's uncertainties: repeats the fit with its noise, starting from its result, with the input
// a little larger and a little smaller.
std::vector<Systematic> systematic_of(std::span<const Sample> samples, const FitSetup& setup, const ElasticFit& fit);

}  // namespace afm::fits
