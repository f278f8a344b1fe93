// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "fits/elastic_fit.h"

namespace afm::fits {

// For each of the setup's uncertainties: the fit repeated with its noise, from its end, with what was given a little
// larger and a little smaller.
std::vector<Systematic> systematic_of(std::span<const Sample> samples, const FitSetup& setup, const ElasticFit& fit);

}  // namespace afm::fits
