// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

// Any text with columns of numbers, which `reading.columns` names: separated by tabs, semicolons, commas or blanks,
// with points, or commas where they do not separate, before the decimals. Lines above the first that is all numbers are
// a heading; empty lines and those with # are left out, and so, with a remark, is a first line of numbers that counts
// those below it. Without a segment the curve turns where its height does. Throws
// CurveError.
RecordedCurve read_column_table(std::string_view bytes, const CurveReading& reading);

}  // namespace afm::curves
