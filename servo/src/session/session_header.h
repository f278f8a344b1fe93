// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "servo/session_file.h"

namespace afm::servo {

// All of a session but its records: material, law, parameters, the device's limits, the scales, and what the wall
// showed when it began.
nlohmann::json header_of(const RecordedSession& session);

// Both throw nlohmann::json::exception when a key is missing or of the wrong type.
RecordedSession session_of(const nlohmann::json& header);
bool fits_records(const nlohmann::json& header);  // whether records have the sizes that this program gives them

}  // namespace afm::servo
