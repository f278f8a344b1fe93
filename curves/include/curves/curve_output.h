// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "curves/curve_run.h"
#include "curves/recorded_curve.h"
#include "curves/svg_plot.h"

namespace afm::curves {

// "# key: value" lines: model, place on the adhesion map, every number that acts, in SI, and where it comes from. What
// curves begin with.
std::string setup_header(const ContactSetup& setup, const std::string& model,
                         const std::optional<physics::LawChoice>& place);

// The same for a sweep, without the numbers that change from row to row.
std::string setup_header(const ContactSetup& setup, std::span<const ContactParameter* const> swept);

// CSV in SI: a # header with every parameter and its source, a line of column names with units, one line a sample.
std::string curve_csv(const CurveRun& run);

// The samples as any file holds them, with what the CSV's header says as parameters.
RecordedCurve recorded_curve(const CurveRun& run);

// The numbers that act as {"tip_radius_m": ...}; null where JSON has no such number.
nlohmann::ordered_json parameters_json(const ContactSetup& setup);

// The events as the design's section 4 prints them, what the law was chosen by, and the sources; null for a jump that
// did not happen in the sweep, for the energy of a loop that stayed open, and for what is infinite.
nlohmann::ordered_json curve_json(const CurveRun& run);

// Approach dashed and retract solid, with both jumps marked.
SvgPlot curve_plot(const CurveRun& run);

}  // namespace afm::curves
