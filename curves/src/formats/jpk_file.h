// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

// JPK's .jpk-force: a zip archive with a folder for each segment, which contains a .properties file and a raw file of
// big-endian integers for each channel. An encoder converts the integers to volts and a chain of linear conversions
// these to metres and newtons. Leaves out pauses and oscillations, with a remark. Rejects maps and QI files, which
// contain many curves, with their
// names. Throws CurveError.
RecordedCurve read_jpk(std::string_view bytes, const CurveReading& reading);

}  // namespace afm::curves
