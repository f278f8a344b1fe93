// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

// Asylum Research's Igor binary wave (.ibw): WaveMetrics' Technical Note 003, version 5, little-endian, a wave with one
// column per channel, named by the dimension labels, with the calibration in the note. Ignores points that Igor left as
// NaN. The note's Indexes and Direction tell the sections of the cycle, of which those where the tip rests are left out
// with a remark; without them it turns at its deepest point. Throws CurveError, also for a note without a calibration
// that `reading` lacks too.
RecordedCurve read_igor(std::string_view bytes, const CurveReading& reading);

// Calibration, speeds, instrument and date in a note of Asylum's program. Throws CurveError for a number that is none.
CurveMetadata asylum_metadata(std::string_view note);

}  // namespace afm::curves
