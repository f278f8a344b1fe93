// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "app/doctor/diagnosis.h"

namespace afm::app {

// Array "checks" of touchafm doctor --json.
nlohmann::json to_json(const std::vector<Finding>& findings);

}  // namespace afm::app
