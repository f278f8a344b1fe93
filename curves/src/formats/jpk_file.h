// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

// JPK's .jpk-force: a zip archive with a folder a segment, in it a .properties file and a raw file of big-endian
// integers a channel. An encoder turns the integers into volts and a chain of linear conversions these into metres and
// newtons. Segments of a pause are passed over. Maps and QI files, which hold many curves, are refused by name.
// Throws CurveError.
RecordedCurve read_jpk(std::string_view bytes, const CurveReading& reading);

}  // namespace afm::curves
