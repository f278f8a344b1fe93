// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace afm::test {

using Report = std::vector<std::uint8_t>;

// Bytes of a text such as "37 00 9a".
inline Report from_hex(const std::string& text) {
  std::istringstream in(text);
  Report report;
  for (unsigned byte = 0; in >> std::hex >> byte;) report.push_back(static_cast<std::uint8_t>(byte));
  return report;
}

}  // namespace afm::test
