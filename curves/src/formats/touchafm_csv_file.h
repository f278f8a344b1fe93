// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "curves/recorded_curve.h"

namespace afm::curves {

// Output of `touchafm curve`: "# key: value" lines, a line of column names with units, rows separated by commas. Needs
// the columns z_m, force_N and branch. Throws CurveError.
RecordedCurve read_touchafm_csv(std::string_view bytes);

}  // namespace afm::curves
