// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/recorded_curve.h"
#include "curves/svg_plot.h"

namespace afm::curves {

// A curve with the results of its analysis (physics/curve_analysis.h).
struct AnalysedCurve {
  std::string name;  // name in legends and messages
  RecordedCurve curve;
  physics::CurveFeatures features;
};

// Analyses a curve. A computed curve keeps its zero of the force; a measured one gets a baseline. BadInputFile, naming
// the curve, if it cannot be analysed or the requested method finds no contact point. By default the analysis chooses
// the method (physics/curve_analysis.h).
core::Result<AnalysedCurve> analysed(std::string name, RecordedCurve curve,
                                     std::optional<physics::ContactMethod> method = std::nullopt,
                                     const physics::BaselineChoice& baseline = {});

// One line per feature, with its unit, places relative to the contact point; with another curve, also its figures and
// the differences. `other` may be null.
std::string features_text(const AnalysedCurve& measured, const AnalysedCurve* other);

// Features as JSON in SI. A feature that was not found is null; "beside" and "difference" (this minus the other) exist
// only with another curve.
nlohmann::ordered_json features_json(const AnalysedCurve& measured, const AnalysedCurve* other);

// Approach and retract for comparison: the contact point at Z = 0 (without one, the curve's own zero), the baseline
// subtracted.
std::vector<SvgLine> curve_lines(const AnalysedCurve& curve, const std::string& color);

// Plot of both curves, with the measured one's events marked.
SvgPlot features_plot(const AnalysedCurve& measured, const AnalysedCurve* other);

}  // namespace afm::curves
