// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "curves/recorded_curve.h"

namespace afm::curves {

// Asylum Research's Igor binary wave (.ibw): WaveMetrics' Technical Note 003, version 5, little-endian, a wave of one
// column a channel, whose names are the dimension labels and whose calibration is in the note. Points that Igor
// left as NaN are passed over; the cycle turns at its deepest point. Throws CurveError.
RecordedCurve read_igor(std::string_view bytes);

}  // namespace afm::curves
