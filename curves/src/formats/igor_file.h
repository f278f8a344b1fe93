// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "curves/recorded_curve.h"

namespace afm::curves {

// Asylum Research's Igor binary wave (.ibw): WaveMetrics' Technical Note 003, version 5, little-endian, a wave with one
// column per channel, named by the dimension labels, with the calibration in the note. Ignores points that Igor left as
// NaN. The cycle turns at its deepest point. Throws CurveError.
RecordedCurve read_igor(std::string_view bytes);

}  // namespace afm::curves
