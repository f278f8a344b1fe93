// SPDX-License-Identifier: Apache-2.0
#include "architecture/tokens.h"

#include <algorithm>
#include <cctype>

namespace afm::support {

namespace {

constexpr bool is_word(char c) { return (std::isalnum(static_cast<unsigned char>(c)) != 0) || c == '_'; }

// End of the literal that begins at `at` with this quote.
std::size_t after_literal(std::string_view source, std::size_t at) {
  const char quote = source[at];
  for (++at; at < source.size() && source[at] != quote; ++at) {
    if (source[at] == '\\') ++at;
  }
  return at + 1;
}

// End of the raw string whose quote is at `at`.
std::size_t after_raw_string(std::string_view source, std::size_t at) {
  const std::size_t open = source.find('(', at);
  const std::string close = ")" + std::string(source.substr(at + 1, open - at - 1)) + "\"";
  return std::min(source.size(), source.find(close, open) + close.size());
}

// End of the line, with the lines that continue it.
std::size_t after_directive(std::string_view source, std::size_t at) {
  std::size_t end = source.find('\n', at);
  while (end != std::string_view::npos && source[end - 1] == '\\') end = source.find('\n', end + 1);
  return std::min(end, source.size());
}

}  // namespace

Tokens tokens_of(std::string_view source) {
  Tokens tokens;
  std::size_t i = 0;
  while (i < source.size()) {
    const char c = source[i];
    const std::string_view rest = source.substr(i);
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++i;
    } else if (rest.starts_with("//")) {
      i = std::min(source.find('\n', i), source.size());
    } else if (rest.starts_with("/*")) {
      i = std::min(source.find("*/", i), source.size() - 2) + 2;
    } else if (c == '#') {
      i = after_directive(source, i);
    } else if (rest.starts_with("R\"")) {
      i = after_raw_string(source, i + 1);
      tokens.emplace_back("\"\"");
    } else if (c == '"' || c == '\'') {
      i = after_literal(source, i);
      tokens.emplace_back("\"\"");
    } else if (is_word(c)) {
      std::size_t end = i;
      // a digit separator belongs to its number
      while (end < source.size() &&
             (is_word(source[end]) || (source[end] == '\'' && std::isdigit(static_cast<unsigned char>(c)) != 0))) {
        ++end;
      }
      tokens.emplace_back(source.substr(i, end - i));
      i = end;
    } else if (rest.starts_with("::")) {
      tokens.emplace_back("::");
      i += 2;
    } else {
      tokens.emplace_back(1, c);
      ++i;
    }
  }
  return tokens;
}

bool is_name(const std::string& token) {
  return is_word(token.front()) && std::isdigit(static_cast<unsigned char>(token.front())) == 0;
}

std::size_t after_bracket(const Tokens& tokens, std::size_t at) {
  int depth = 0;
  for (; at < tokens.size(); ++at) {
    const std::string& token = tokens[at];
    if (token == "(" || token == "[" || token == "{") ++depth;
    if (token == ")" || token == "]" || token == "}") --depth;
    if (depth == 0) return at + 1;
  }
  return at;
}

}  // namespace afm::support
