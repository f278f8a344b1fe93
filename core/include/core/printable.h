// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace afm::core {

// Makes text from a device, a driver or a file safe for a terminal and a JSON file: invalid UTF-8 (RFC 3629) and every
// control character except newline and tab become U+FFFD.
std::string printable(std::string_view text);

// As printable(), for text that must be one line: newlines and tabs become spaces.
std::string printable_line(std::string_view text);

// Number of characters of a text in valid UTF-8: of all bytes except continuation bytes.
std::size_t count_characters(std::string_view text);

}  // namespace afm::core
