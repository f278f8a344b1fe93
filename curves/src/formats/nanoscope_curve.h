// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

inline constexpr std::string_view kNanoscopeForceMagic = "\\*Force file list";

// A single ramp of Bruker's Nanoscope (.spm, .000, .pfc): a block "\*Ciao force image list" per channel, whose data
// are the extend, from the sample outwards, then the retract in the order of time, in integers of two or four bytes.
// Points that were not recorded have the lowest integer. Of two lengths in "\Samps/line" the first is the retract's.
// The heights are those of the sensor, otherwise evenly spaced over the ramp. Throws CurveError, also for a force
// volume, and for a file without a calibration that `reading` lacks too.
RecordedCurve read_nanoscope_curve(std::string_view bytes, const CurveReading& reading);

}  // namespace afm::curves
