// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::core {

// Text of a report in JSON. Names of files may hold bytes that are no UTF-8, for which dump() alone throws: they become
// U+FFFD. `indent`: blanks a level; -1: all on one line.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace afm::core
