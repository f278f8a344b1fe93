// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace afm::core {

// Spreadsheets save UTF-8 with a byte order mark, and lines that end as those of Windows.
constexpr std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

// A line, cut at its line feed, without the carriage return before it.
constexpr std::string_view without_line_end(std::string_view line) {
  return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

}  // namespace afm::core
