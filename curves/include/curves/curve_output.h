// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "curves/curve_run.h"
#include "curves/recorded_curve.h"
#include "curves/svg_plot.h"

namespace afm::curves {

// First lines of a curve's output, "# key: value": model, position on the adhesion map, and every number that acts, in
// SI, with its origin.
std::string setup_header(const ContactSetup& setup, const std::string& model,
                         const std::optional<physics::LawChoice>& place);

// First lines of a sweep's output, as of a curve's, without the swept numbers.
std::string setup_header(const ContactSetup& setup, std::span<const ContactParameter* const> swept);

// CSV in SI: a # header with every parameter and its source, a line of column names with units, one line per sample.
std::string curve_csv(const CurveRun& run);

// The samples in the form of a curve file, with the CSV header's contents as parameters.
RecordedCurve recorded_curve(const CurveRun& run);

// The numbers that act as {"tip_radius_m": ...}; null for a number that JSON cannot represent.
nlohmann::ordered_json parameters_json(const ContactSetup& setup);

// First keys of a curve's JSON: the model, the basis for its choice, and the position on the adhesion map.
nlohmann::ordered_json law_json(const ContactSetup& setup, const std::string& model,
                                const std::optional<physics::LawChoice>& place);

// Sources of the law and of the numbers that act, in the material's order; for a sweep without the swept numbers, and
// without a law that may change from point to point.
std::vector<scene::SourcedValue> acting_sources(const ContactSetup& setup,
                                                std::span<const ContactParameter* const> swept = {});

// A source as a line of a table: "# source of tip_radius: 50 nm, Liu & Peng, Table 1".
std::string source_line(const scene::SourcedValue& source);

// Sources as JSON: {KEY: {"value", "source", "estimated"}}.
nlohmann::ordered_json sources_json(std::span<const scene::SourcedValue> sources);

// Adds the sources as "sources", and the keys of those that are estimated.
void add_sources(nlohmann::ordered_json& result, std::span<const scene::SourcedValue> sources);

// Adds a curve's last keys: sources of the law and of the numbers that act, which of them are estimated, the program.
void add_sources(nlohmann::ordered_json& result, const ContactSetup& setup);

// The events as in section 4 of the design, the basis for the choice of the law, and the sources. Null for a jump that
// did not happen in the sweep, for the energy of an open loop, and for infinity.
nlohmann::ordered_json curve_json(const CurveRun& run);

// Approach dashed and retract solid, with both jumps marked.
SvgPlot curve_plot(const CurveRun& run);

}  // namespace afm::curves
