// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "servo/session_file.h"

namespace afm::servo {

// All of a session but its records: material, law, parameters, the device's limits, the scales, and what the wall
// showed when it began.
nlohmann::json header_of(const RecordedSession& session);

// Both throw nlohmann::json::exception when a key is missing or of the wrong type.
RecordedSession session_of(const nlohmann::json& header);

// Whether its samples have this size, and its other records that which this program gives them.
bool fits_records(const nlohmann::json& header, std::size_t sample_bytes);

}  // namespace afm::servo
