// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace afm::instrument {

// The object of one line. RefusedRequest, with the reason, for anything else: no JSON, a number beyond a float, a
// member that is given twice, more than eight levels.
nlohmann::ordered_json parsed_request(std::string_view line);

// The "id" that the answer repeats; null without one. RefusedRequest for one that it could not repeat.
nlohmann::ordered_json id_of(const nlohmann::ordered_json& request);

}  // namespace afm::instrument
