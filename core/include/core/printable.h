// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace afm::core {

// Text of a device, a driver or a file as a terminal and a JSON file may be given it: what is no UTF-8 (RFC 3629), and
// every control character but the end of a line and the tab, becomes U+FFFD.
std::string printable(std::string_view text);

// The same for what must be one line: ends of lines and tabs become spaces.
std::string printable_line(std::string_view text);

}  // namespace afm::core
