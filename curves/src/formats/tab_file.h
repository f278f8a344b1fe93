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

// A curve for another process of this machine: the heading of its .tab, and the numbers as they are in memory,
// which take a tenth of the time of their digits. Reads a .tab, too: that of a program of ours. Throws CurveError for
// anything that was not written so.
std::string handed_bytes(const RecordedCurve& curve);
RecordedCurve read_handed(std::string_view bytes);

}  // namespace afm::curves
