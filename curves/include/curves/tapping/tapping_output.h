// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "curves/svg_plot.h"
#include "curves/tapping/tapping_run.h"

namespace afm::curves {

// CSV in SI, phases in degrees: a # header with every parameter, its source and the conventions, then a row for each
// height, or with `at` for each state.
std::string tapping_csv(const TappingRun& run);
std::string frequency_shift_csv(const FrequencyShiftRun& run);

// Events, loops and islands, or with `at` the states, with parameters and conventions.
nlohmann::ordered_json tapping_json(const TappingRun& run);
nlohmann::ordered_json frequency_shift_json(const FrequencyShiftRun& run);

// Meaning of amplitude, phase, force, virial and heights.
nlohmann::ordered_json tapping_conventions();

// Approach dashed and retract solid: amplitude above phase; frequency shift.
std::vector<SvgPlot> tapping_plots(const TappingRun& run);
std::vector<SvgPlot> frequency_shift_plots(const FrequencyShiftRun& run);

}  // namespace afm::curves
