// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "curves/recorded_curve.h"
#include "curves/synthetic_curve.h"

namespace afm::curves {

// Software name in synthetic curves. It differs from kComputedBy, whose curves have no baseline.
inline constexpr const char* kSyntheticBy = "TouchAFM generate";

// Truth common to all curves of a file: law with its source, numbers that act, seed, program. "curves" is an empty
// list.
nlohmann::ordered_json truth_of(const SyntheticSetup& setup, std::string_view kind);

// Adds to a map's truth its grid, its field, and the field's values row by row from the bottom; to each curve its
// place.
void add_map(const SyntheticMap& map, const std::vector<RecordedCurve>& curves, nlohmann::ordered_json& truth);

// Centre of a pixel, in the frame of the scanner.
CurvePosition centre_of(const MapPixel& pixel);

}  // namespace afm::curves
