// SPDX-License-Identifier: Apache-2.0
#include "curves/fitting/fitted_curve.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <utility>
#include <vector>

#include "curves/curve_report.h"

namespace afm::curves {

namespace {

CurveFigures figures_of(const physics::CurveFeatures& features) {
  CurveFigures figures;
  if (features.adhesion) figures.adhesion_n = std::abs(features.adhesion->force.si);
  if (features.snap_in) figures.snap_in_n = std::abs(features.snap_in->force_after.si);
  if (features.contact_slope) figures.contact_slope_n_per_m = features.contact_slope->si;
  figures.loop_energy_j = features.loop_energy.si;
  figures.adhesion_energy_j = features.adhesion_energy.si;
  return figures;
}

}  // namespace

FittedCurve fitted_curve(const std::string& file, core::Result<RecordedCurve> curve, const FitOptions& options,
                         std::optional<physics::ContactMethod> method, const physics::BaselineChoice& baseline) {
  FittedCurve result;
  try {
    if (!curve) {
      result.why = curve.error().message;
      return result;
    }
    result.position = curve->metadata.position;
    result.pixel = curve->metadata.pixel;
    result.remarks = curve->metadata.remarks;
    const auto analysis = analysed(file, std::move(*curve), method, baseline);
    if (!analysis) {
      result.why = analysis.error().message;
      return result;
    }
    result.figures = figures_of(analysis->features);
    if (!options.shape) return result;
    auto fit = fit_of(*analysis, options);
    if (!fit) {
      result.why = fit.error().message;
      return result;
    }
    result.fit = std::move(*fit);
    result.fit->model_n = std::vector<double>();  // memory of the model's forces, not needed any more
    result.spring_n_per_m = analysis->curve.metadata.spring_constant->si;
  } catch (const std::exception& error) {  // a curve too large for the memory of this machine
    result.fit.reset();
    result.why = fmt::format("cannot fit {}: {}", file, error.what());
  }
  return result;
}

}  // namespace afm::curves
