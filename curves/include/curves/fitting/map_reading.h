// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "curves/fitting/map_fit.h"

namespace afm::curves {

// The calibration and the fit, if there is one, of a map that is felt as one line of JSON, in SI, for a
// session. Sizes that no such fit has are left out.
std::string text_of(const MapReading& reading);

// The inverse of text_of(), with the same bits. BadInputFile, without the name of a file, for a malformed text and a
// number outside the range of its option.
core::Result<MapReading> map_reading_of(std::string_view text);

}  // namespace afm::curves
