// SPDX-License-Identifier: Apache-2.0
#include "core/file_names.h"

namespace afm::core {

std::string in_file_name(std::string_view name) {
  std::string part;
  for (const char letter : name) {
    if (letter == '/') {
      part += "%2F";
    } else {
      part += letter;
    }
  }
  return part;
}

}  // namespace afm::core
