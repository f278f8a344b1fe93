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

// A curve with what its analysis found (physics/curve_analysis.h).
struct AnalysedCurve {
  std::string name;  // name in legends and messages
  RecordedCurve curve;
  physics::CurveFeatures features;
};

// A computed curve keeps its own zero of the force; a measured one gets a baseline. BadInputFile, naming the curve, if
// it cannot be analysed, and if the method that was asked for finds no contact point. Without a method the analysis
// chooses one (physics/curve_analysis.h).
core::Result<AnalysedCurve> analysed(std::string name, RecordedCurve curve,
                                     std::optional<physics::ContactMethod> method = std::nullopt);

// One line a feature, with its unit, places from the contact point; with another curve its figures and the differences
// stand beside. `other` may be null.
std::string features_text(const AnalysedCurve& measured, const AnalysedCurve* other);

// The same in SI. A feature that was not found is null; "beside" and "difference" (this less the other) appear
// with another.
nlohmann::ordered_json features_json(const AnalysedCurve& measured, const AnalysedCurve* other);

// Approach and retract as they are compared: the contact point at Z = 0 (where there is none, the curve's own zero) and
// the baseline taken away.
std::vector<SvgLine> curve_lines(const AnalysedCurve& curve, const std::string& color);

// Both curves, with the measured one's events marked.
SvgPlot features_plot(const AnalysedCurve& measured, const AnalysedCurve* other);

}  // namespace afm::curves
