// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::core {

// Text of a report in JSON. Names of files may contain bytes that are no UTF-8, on which dump() throws: they become
// U+FFFD. `indent`: blanks per level; -1: all on one line.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace afm::core
