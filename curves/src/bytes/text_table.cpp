// SPDX-License-Identifier: Apache-2.0
#include "bytes/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/printable.h"
#include "curves/curve_error.h"

namespace afm::curves {

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  line = rest_.substr(0, end);
  open_ = end == rest_.size();
  rest_.remove_prefix(rest_.substr(end).starts_with("\r\n") ? end + 2 : std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

void refuse_fields(const Lines& lines, std::size_t fields, std::size_t of_heading) {
  if (lines.is_open()) throw CutShort(fmt::format("its last line has {} of {} fields", fields, of_heading));
  throw CurveError(fmt::format("line {} has {} field{}, the heading {}", lines.number(), fields, fields == 1 ? "" : "s",
                               of_heading));
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

void split(std::string_view text, char separator, std::vector<std::string_view>& parts) {
  parts.clear();
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

bool has_decimal_comma(std::string_view text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t at = text.find(','); at != std::string_view::npos; at = text.find(',', at + 1)) {
    if (at > 0 && at + 1 < text.size() && is_digit(text[at - 1]) && is_digit(text[at + 1])) return true;
  }
  return false;
}

std::string decimal_comma_in(std::string_view name, std::string_view text) {
  return fmt::format("{} is \"{}\", with a decimal comma; write a decimal point", name,
                     core::printable_line(text.substr(0, 40)));
}

std::optional<double> take_decimal(std::string_view& text) {
  std::string_view digits = text;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text = digits.substr(static_cast<std::size_t>(end - digits.data()));
  return value;
}

double number_in(std::string_view field, std::string_view column, const Lines& lines) {
  field = trimmed(field);
  std::string_view rest = field;
  const auto value = take_decimal(rest);
  if (!value || !rest.empty()) {
    if (lines.is_open())
      throw CutShort(fmt::format("its last line has \"{}\" as {}", core::printable_line(field), column));
    const std::string place = lines.number() == 0 ? std::string() : fmt::format("line {}: ", lines.number());
    if (has_decimal_comma(field)) throw CurveError(place + decimal_comma_in(column, field));
    throw CurveError(
        fmt::format("{}{} is \"{}\", not a finite number", place, column, core::printable_line(field.substr(0, 40))));
  }
  return *value;
}

std::size_t column_in(const std::vector<std::string_view>& heading, std::string_view name) {
  const auto found = std::find(heading.begin(), heading.end(), name);
  if (found == heading.end()) throw CurveError(fmt::format("it has no column \"{}\"", name));
  return static_cast<std::size_t>(found - heading.begin());
}

}  // namespace afm::curves
