// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "curves/curve_map.h"
#include "curves/fitting/curve_fit.h"

namespace afm::curves {

// Settings with which the curves of a map are read.
struct MapReading {
  CurveReading calibration;  // calibration of the curves, whose index is not used
  FitOptions fit;            // settings of the fits; without a shape no curve is fitted
};

// Fits each curve of the map in `path` as fitted_curve() does. `options` is prepared and asks for a fit; a copy is
// kept.
CurveMap::Fit fit_of_each(const std::string& path, const FitOptions& options);

// Text for the log: "12 fits are trusted, 3 doubtful, 1 not trusted; 2 curves have none".
std::string fits_text(const CurveMap& map);

}  // namespace afm::curves
