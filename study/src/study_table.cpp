// SPDX-License-Identifier: Apache-2.0
#include "study_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "core/printable.h"
#include "core/text_lines.h"

namespace afm::study {

namespace {

constexpr std::size_t kMostLines = 100'000;
constexpr std::size_t kLongestWord = 64;

// Fields without the quotes that some spreadsheets put around each.
std::vector<std::string_view> tab_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t tab = line.find('\t');
    std::string_view field = line.substr(0, tab);
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    fields.push_back(field);
    if (tab == std::string_view::npos) return fields;
    line.remove_prefix(tab + 1);
  }
}

tl::unexpected<core::Error> bad_line(const std::string& name, std::size_t line, const std::string& what) {
  return core::failure(core::ErrorCategory::BadInputFile, fmt::format("{}:{}: {}", name, line, what));
}

constexpr std::size_t kNowhere = std::string_view::npos;

// Index in the header of each wanted column; kNowhere for a missing one of the last `newer`.
core::Result<std::vector<std::size_t>> column_places(const std::vector<std::string_view>& header,
                                                     const std::string& name, std::span<const std::string_view> columns,
                                                     std::size_t newer) {
  for (const std::string_view each : header) {
    if (std::find(columns.begin(), columns.end(), each) != columns.end()) continue;
    return bad_line(name, 1, fmt::format("unknown column \"{}\"", core::printable(each.substr(0, kLongestWord))));
  }
  std::vector<std::size_t> places;
  for (const std::string_view column : columns) {
    const auto found = std::find(header.begin(), header.end(), column);
    if (found == header.end() && places.size() + newer >= columns.size()) {
      places.push_back(kNowhere);
      continue;
    }
    if (found == header.end()) return bad_line(name, 1, fmt::format("there is no column \"{}\"", column));
    if (std::find(found + 1, header.end(), column) != header.end()) {
      return bad_line(name, 1, fmt::format("the column \"{}\" is there twice", column));
    }
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  return places;
}

}  // namespace

tl::unexpected<core::Error> TsvTable::bad(std::size_t row, const std::string& what) const {
  return bad_line(name, row + 2, what);
}

core::Result<TsvTable> parse_tsv(std::string_view bytes, const std::string& name,
                                 std::span<const std::string_view> columns, std::size_t newer) {
  TsvTable table{.name = name, .lines = {}, .cut_line = 0};
  std::vector<std::size_t> places;
  std::size_t width = 0;
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    return bad_line(name, 1, "the text is UTF-16; save it as UTF-8, with tabs between the columns");
  }
  bytes = core::without_byte_order_mark(bytes);
  for (std::size_t number = 1; !bytes.empty(); ++number) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos) {
      table.cut_line = number;
      break;
    }
    if (number > kMostLines) return bad_line(name, number, fmt::format("more than {} lines", kMostLines));
    const std::vector<std::string_view> fields = tab_fields(core::without_line_end(bytes.substr(0, end)));
    bytes.remove_prefix(end + 1);
    if (number == 1) {
      auto found = column_places(fields, name, columns, newer);
      if (!found) return tl::unexpected(found.error());
      places = std::move(*found);
      width = fields.size();
      continue;
    }
    if (fields.size() == 1 && fields.front().find_first_not_of(" \r") == kNowhere) continue;  // empty line of an editor
    if (fields.size() != width) {
      return bad_line(name, number,
                      fmt::format("{} field{} instead of {}", fields.size(), fields.size() == 1 ? "" : "s", width));
    }
    std::vector<std::string_view>& line = table.lines.emplace_back();
    for (const std::size_t place : places) {
      line.push_back(place == kNowhere || fields[place] == "n/a" ? "" : fields[place]);
    }
  }
  if (places.empty()) return bad_line(name, 1, "there is no header line");
  return table;
}

std::optional<double> parse_number(std::string_view text, double least, double most) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value >= least && value <= most ? std::optional(value) : std::nullopt;
}

bool is_word(std::string_view text) {
  return !text.empty() && text.size() <= kLongestWord && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.' || c == '+';
  });
}

}  // namespace afm::study
