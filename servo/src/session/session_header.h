// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "servo/session_file.h"

namespace afm::servo {

// Everything in a session except its records: material, law, parameters, the device's limits, the scales, and the state
// of the wall at the beginning.
nlohmann::json header_of(const RecordedSession& session);

// Both functions throw nlohmann::json::exception if a key is missing or of the wrong type.
RecordedSession session_of(const nlohmann::json& header);

// True if its samples have this size, and its other records the sizes that this program writes.
bool fits_records(const nlohmann::json& header, std::size_t sample_bytes);

}  // namespace afm::servo
