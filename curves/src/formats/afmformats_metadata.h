// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "curves/recorded_curve.h"

namespace afm::curves {

// The curve's metadata under the keys of afmformats, whose list is closed. A value is a text or a number in SI.
nlohmann::ordered_json afmformats_metadata(const RecordedCurve& curve);

// Takes what is known from a JSON object; other keys are passed over. Throws CurveError for an imaging mode that is no
// force-distance curve and for a known key with a value of another kind.
void read_afmformats_metadata(const nlohmann::json& from, CurveMetadata& metadata);

}  // namespace afm::curves
