// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

// AFM Workshop's force-distance .csv: "key:<tab>value" lines, then columns in nm, increasing towards the sample, and in
// nN or, uncalibrated, in volts. Gwyddion assumes evenly spaced heights and equally long branches.
std::string workshop_bytes(const RecordedCurve& curve);

// Reads such a file. Throws CurveError. Volts need sensitivity and spring constant from the file or from `reading`.
RecordedCurve read_workshop(std::string_view bytes, const CurveReading& reading);

}  // namespace afm::curves
