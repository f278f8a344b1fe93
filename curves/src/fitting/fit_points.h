// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "curves/curve_report.h"
#include "curves/fitting/curve_fit.h"
#include "fits/elastic_fit.h"

namespace afm::curves {

// Points of a curve that a fit uses, and their indices in the curve.
struct FitPoints {
  std::vector<fits::Sample> samples;
  std::vector<std::size_t> places;
};

// Points for a fit. Without adhesion the approach, up to the first point beyond a limit of `options`; with it, of both
// branches those that surely stick and those that are surely free (docs/fits.md). The curve has a spring constant.
FitPoints fit_points(const AnalysedCurve& curve, const FitOptions& options);

}  // namespace afm::curves
