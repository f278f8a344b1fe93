// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

// AFM Workshop's force-distance .csv: "key:<tab>value" lines, then columns in nm that grow towards the sample, in nN
// or, uncalibrated, in volts. Gwyddion takes the heights as evenly spaced and needs both branches equally long.
std::string workshop_bytes(const RecordedCurve& curve);

// Throws CurveError; for volts it needs sensitivity and spring constant from the file or from `reading`.
RecordedCurve read_workshop(std::string_view bytes, const CurveReading& reading);

}  // namespace afm::curves
