// SPDX-License-Identifier: Apache-2.0
#include "scene/config/toml_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/file_kind.h"
#include "core/printable.h"
#include "core/whole_file.h"

namespace afm::scene {

namespace {

constexpr std::size_t kLargestBytes = std::size_t{4} << 20U;
constexpr std::size_t kMostParts = 16;

core::Error bad(const char* kind, const std::string& path, const std::string& what) {
  return {core::ErrorCategory::BadInputFile, fmt::format("{} {}: {}", kind, path, what)};
}

// Kind of a file that is no text in UTF-8, such as a failed download, with advice; empty for any other.
std::string other_file(std::string_view text) {
  const auto kind = core::file_kind(text.substr(0, core::kFileKindBytes), text.size());
  if (!kind) return "";
  using core::FileRole;
  if (kind->role == FileRole::Spreadsheet || kind->role == FileRole::Document) {
    return fmt::format("it is {}; save it as plain text in UTF-8", kind->name);
  }
  constexpr std::array kRoles{FileRole::Archive, FileRole::LfsPointer, FileRole::WebPage, FileRole::OtherText};
  if (std::find(kRoles.begin(), kRoles.end(), kind->role) == kRoles.end()) return "";
  return fmt::format("it is {}; {}", kind->name, core::remedy_of(kind->role));
}

// Text after a string that begins at `at`; the end of the text if the string does not end.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string long_quote(3, quote);
  const bool is_long = text.substr(at).starts_with(long_quote);
  for (std::size_t i = at + (is_long ? 3 : 1); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (is_long ? text.substr(i).starts_with(long_quote) : text[i] == quote) {
      return i + (is_long ? 3 : 1);
    } else if (!is_long && text[i] == '\n') {
      return i;
    }
  }
  return text.size();
}

// The line of the first key or header of more parts than kMostParts. toml++ nests a table for each and calls itself for
// each, until the stack ends.
std::optional<std::size_t> line_of_too_long_key(std::string_view text) {
  std::size_t line = 1, dots = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_string(text, i);
      line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                  text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end;
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (c == '.' && ++dots >= kMostParts) return line;
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) dots = 0;
    line += c == '\n' ? 1U : 0U;
    ++i;
  }
  return std::nullopt;
}

// Line of a text with a character that could command a terminal or break a line of a curve file.
std::optional<std::size_t> line_of_control_character(const toml::node& node) {
  if (const toml::value<std::string>* text = node.as_string()) {
    if (core::printable_line(text->get()) != text->get()) return node.source().begin.line;
  } else if (const toml::array* array = node.as_array()) {
    for (const toml::node& inner : *array) {
      if (const auto line = line_of_control_character(inner)) return line;
    }
  } else if (const toml::table* table = node.as_table()) {
    for (const auto& [key, inner] : *table) {
      if (const auto line = line_of_control_character(inner)) return line;
    }
  }
  return std::nullopt;
}

}  // namespace

core::Result<toml::table> parse_toml(const char* kind, const std::string& path) {
  const auto text = core::read_file(path);
  if (!text) {
    // "cannot read PATH: there is no such file"
    const std::string& why = text.error().message;
    return tl::unexpected(bad(kind, path, "cannot be read" + why.substr(std::min(why.rfind(": "), why.size()))));
  }
  if (text->size() > kLargestBytes) return tl::unexpected(bad(kind, path, "is larger than 4 MiB"));
  if (const auto line = line_of_too_long_key(*text)) {
    return tl::unexpected(bad(kind, path, fmt::format("line {}: a key has more than {} parts", *line, kMostParts)));
  }
  if (const std::string why = other_file(*text); !why.empty()) return tl::unexpected(bad(kind, path, why));
  try {
    toml::table root = toml::parse(*text, path);
    if (const auto line = line_of_control_character(root)) {
      return tl::unexpected(bad(
          kind, path,
          fmt::format("line {}: a text contains a line end, a tab or another control character; write it on one line",
                      *line)));
    }
    return root;
  } catch (const toml::parse_error& error) {
    // the message quotes the text it found, which may be the end of the line
    const std::string what = core::printable_line(error.description());
    const bool other_text = what.find("utf-8") != std::string::npos;
    return tl::unexpected(bad(
        kind, path,
        fmt::format("line {}: {}{}", error.source().begin.line, what, other_text ? "; save the file in UTF-8" : "")));
  }
}

core::Error toml_error(const char* kind, const std::string& path, const Fault& fault) {
  return bad(kind, path,
             fmt::format("line {}: {}: {}", std::max<std::uint32_t>(1, fault.where.begin.line), fault.key, fault.what));
}

}  // namespace afm::scene
