// SPDX-License-Identifier: Apache-2.0
#include "bytes/spreadsheet_text.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bytes/text_table.h"

namespace afm::curves {

namespace {

struct ColumnsLine {
  std::size_t offset = 0;
  char separator = ',';
};

// First line with the column among its cells.
std::optional<ColumnsLine> columns_line(std::string_view bytes, std::string_view column) {
  std::string_view line;
  std::vector<std::string_view> cells;
  for (Lines lines(bytes); lines.next(line);) {
    if (line.find(column) == std::string_view::npos) continue;
    for (const char separator : {',', ';'}) {
      split(line, separator, cells);
      const bool names_it =
          std::any_of(cells.begin(), cells.end(), [column](std::string_view cell) { return trimmed(cell) == column; });
      if (cells.size() > 1 && names_it)
        return ColumnsLine{static_cast<std::size_t>(line.data() - bytes.data()), separator};
    }
  }
  return std::nullopt;
}

bool is_quoted(std::string_view line) { return line.size() >= 2 && line.front() == '"' && line.back() == '"'; }

// Line above the columns without the empty cells at its end.
std::string_view without_empty_cells(std::string_view line, char separator) {
  return line.substr(0, line.find_last_not_of(separator) + 1);
}

// Text of a cell without its quotes.
std::string unquoted(std::string_view line) {
  std::string text(line.substr(1, line.size() - 2));
  for (std::size_t at = 0; (at = text.find("\"\"", at)) != std::string::npos; ++at) text.erase(at, 1);
  return text;
}

}  // namespace

std::optional<std::string> undo_spreadsheet(std::string_view bytes, std::string_view column) {
  const auto columns = columns_line(bytes, column);
  if (!columns) return std::nullopt;
  const char separator = columns->separator;
  bool saved_again = separator != ',';
  std::string text;
  std::string_view line;
  for (Lines lines(bytes.substr(0, columns->offset)); lines.next(line);) {
    const std::string_view cell = without_empty_cells(line, separator);
    // a remark in the heading may end with a comma
    saved_again = saved_again || is_quoted(cell) || (lines.number() == 1 && cell.size() < line.size());
    text += is_quoted(cell) ? unquoted(cell) : std::string(cell);
    text.push_back('\n');
  }
  if (!saved_again) return std::nullopt;
  if (separator != ',') std::replace(text.begin(), text.end(), separator, ',');
  const std::size_t table = text.size();
  text += bytes.substr(columns->offset);
  if (separator == ',') return text;
  std::transform(text.begin() + static_cast<std::ptrdiff_t>(table), text.end(),
                 text.begin() + static_cast<std::ptrdiff_t>(table), [separator](char c) {
                   return c == separator ? ',' : c == ',' ? '.' : c;
                 });
  return text;
}

}  // namespace afm::curves
