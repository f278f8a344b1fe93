// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "curves/recorded_curve.h"

namespace afm::curves {

// The curve's metadata under the keys of afmformats, which accepts no others. A value is a text or a number in SI.
nlohmann::ordered_json afmformats_metadata(const RecordedCurve& curve);

// Reads the known keys of a JSON object and ignores all others. Throws CurveError for an imaging mode that is not a
// force-distance curve and for a value of the wrong type.
void read_afmformats_metadata(const nlohmann::json& from, CurveMetadata& metadata);

}  // namespace afm::curves
