// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "curves/recorded_curve.h"

namespace afm::curves {

// A curve for another process of this machine, as it is in memory: the digits of a .tab would take most of the time of
// a map. Does not trust the other process: throws CurveError for anything that was not written so.
std::string handed_bytes(const RecordedCurve& curve);
RecordedCurve read_handed(std::string_view bytes);

}  // namespace afm::curves
