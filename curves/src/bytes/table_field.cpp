// SPDX-License-Identifier: Apache-2.0
#include "bytes/table_field.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <system_error>

#include "bytes/text_table.h"

namespace afm::curves {

namespace {

bool is_digit_of_field(char c) { return c >= '0' && c <= '9'; }

// Field without blanks and no-break spaces around it.
std::string_view bare(std::string_view field) {
  constexpr std::array<std::string_view, 2> kNoBreak{"\u00a0", "\u202f"};
  for (bool more = true; more;) {
    more = false;
    field = trimmed(field);
    for (const std::string_view blank : kNoBreak) {
      if (field.starts_with(blank)) {
        field.remove_prefix(blank.size());
        more = true;
      }
      if (field.ends_with(blank)) {
        field.remove_suffix(blank.size());
        more = true;
      }
    }
  }
  return field;
}

// True for a whole number of one to three digits, the first not 0, before a comma and three digits behind it.
bool has_group_of_thousands(std::string_view number, std::size_t comma) {
  constexpr std::size_t kGroup = 3;
  if (number.starts_with('-') || number.starts_with('+')) {
    number.remove_prefix(1);
    --comma;
  }
  const std::string_view behind = number.substr(comma + 1);
  return comma <= kGroup && number[0] != '0' && behind.size() == kGroup &&
         std::all_of(behind.begin(), behind.end(), is_digit_of_field);
}

// Ends of the fields of a line with quotes, in which a separator is text.
void split_quoted(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t at = 0; at <= line.size(); ++at) {
    if (at < line.size() && line[at] == '"') quoted = !quoted;
    if (at < line.size() && (quoted || line[at] != separator)) continue;
    fields.push_back(line.substr(begin, at - begin));
    begin = at + 1;
  }
}

}  // namespace

void split_line(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  if (separator == ',' && line.find('"') != std::string_view::npos) return split_quoted(line, separator, fields);
  if (separator != ' ') return split(line, separator, fields);
  fields.clear();
  for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    fields.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<TableNumber> table_number(std::string_view field, char separator) {
  field = bare(field);
  bool comma_is_text = separator != ',';
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = bare(field.substr(1, field.size() - 2));
    comma_is_text = true;
  }
  std::string text(field);
  // Unicode's minus, as some languages of Windows write it
  constexpr std::string_view kMinus = "\u2212";
  for (std::size_t at = text.find(kMinus); at != std::string::npos; at = text.find(kMinus)) {
    text.replace(at, kMinus.size(), "-");
  }
  TableNumber number;
  number.has_point = text.find('.') != std::string::npos;
  const std::size_t comma = text.find(',');
  if (comma != std::string::npos) {
    const bool between_digits = comma > 0 && is_digit_of_field(text[comma - 1]) && comma + 1 < text.size() &&
                                is_digit_of_field(text[comma + 1]);
    if (!comma_is_text || number.has_point || !between_digits) return std::nullopt;
    number.may_have_thousands = has_group_of_thousands(text, comma);
    text[comma] = '.';
    number.has_comma = true;
  }
  number.is_whole = text.find_first_of(".eEnN") == std::string::npos;
  if (text.starts_with('+')) text.erase(0, 1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
  const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(number.value);
  return is_number ? std::optional(number) : std::nullopt;
}

bool is_factor(std::string_view line) {
  line = trimmed(line);
  if (!line.ends_with('*')) return false;
  const auto number = table_number(line.substr(0, line.size() - 1), ' ');
  return number && number->value != 1.0;
}

}  // namespace afm::curves
