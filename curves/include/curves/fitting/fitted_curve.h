// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/fitting/curve_fit.h"
#include "curves/recorded_curve.h"
#include "fits/elastic_fit.h"
#include "physics/curve_analysis.h"

namespace afm::curves {

// Figures of a curve without a fit (physics/curve_analysis.h); empty: not found. Pulls are magnitudes.
struct CurveFigures {
  std::optional<double> adhesion_n;
  std::optional<double> snap_in_n;
  std::optional<double> contact_slope_n_per_m;
  std::optional<double> loop_energy_j;
  std::optional<double> adhesion_energy_j;
};

// Result for one curve: a fit with its spring constant, or the reason why there is none.
struct FittedCurve {
  std::optional<fits::ElasticFit> fit;  // fit without its model; empty: none
  double spring_n_per_m = 0;
  std::string why;
  std::vector<std::string> remarks;  // remarks of the reading
  CurveFigures figures;
  std::optional<CurvePosition> position;
  std::optional<MapPixel> pixel;
};

// Analyses one curve of `file` and fits it, if `options` asks for a fit; they are prepared. Never throws: a curve that
// cannot be read, analysed or fitted has the reason. Any thread but the servo's.
FittedCurve fitted_curve(const std::string& file, core::Result<RecordedCurve> curve, const FitOptions& options,
                         std::optional<physics::ContactMethod> method = std::nullopt,
                         const physics::BaselineChoice& baseline = {});

}  // namespace afm::curves
