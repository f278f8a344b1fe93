// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "curves/recorded_curve.h"

namespace afm::curves {

// afmformats' .tab: a # header with JSON between BEGIN METADATA and END METADATA, a # line of column names, rows
// separated by tabs. Writes only metadata keys in afmformats' list, because it rejects any other. Reading throws
// CurveError.
std::string tab_bytes(const RecordedCurve& curve);
RecordedCurve read_tab(std::string_view bytes);

}  // namespace afm::curves
