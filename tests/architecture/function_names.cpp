// SPDX-License-Identifier: Apache-2.0
#include "architecture/function_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "architecture/tokens.h"

namespace afm::support {

namespace {

class NameReader {
 public:
  explicit NameReader(const Tokens& tokens) : tokens_(tokens) {}

  FunctionNames read() {
    for (std::size_t i = 0; i < tokens_.size();) i = read_declaration(i);
    return std::move(names_);
  }

 private:
  void use(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if (is_name(tokens_[i])) ++names_.used[tokens_[i]];
    }
  }

  // False for types and macros, which begin with a capital, and for words of the language.
  static bool is_function_name(const std::string& token) {
    constexpr std::array<std::string_view, 6> kWords{"alignas",  "decltype", "explicit",
                                                     "noexcept", "requires", "static_assert"};
    return token.front() >= 'a' && token.front() <= 'z' &&
           std::find(kWords.begin(), kWords.end(), token) == kWords.end();
  }

  // True for the { of a namespace, a class or a linkage, whose contents are declarations.
  bool holds_declarations(std::size_t from, std::size_t brace) const {
    for (std::size_t i = from; i < brace; ++i) {
      const std::string& token = tokens_[i];
      if (token == "enum" || token == "=" || token == "(") return false;
      if (token == "template") i = after_angles(i + 1) - 1;
      if (token == "namespace" || token == "class" || token == "struct" || token == "union") return true;
    }
    return brace > from && tokens_[brace - 1] == "\"\"";
  }

  std::size_t after_angles(std::size_t at) const {
    int depth = 0;
    for (; at < tokens_.size(); ++at) {
      if (tokens_[at] == "<") ++depth;
      if (tokens_[at] == ">") --depth;
      if (depth == 0) return at + 1;
    }
    return at;
  }

  // Reads one declaration, or up to the declarations in its braces; returns the index after it.
  std::size_t read_declaration(std::size_t from) {
    std::size_t function = 0;  // index of its name
    bool ready = true;         // true: no name, value or operator yet
    bool called = false;       // true: parameters seen
    std::size_t i = from;
    for (; i < tokens_.size(); ++i) {
      const std::string& token = tokens_[i];
      if (token == ";" || token == "}") break;
      if (token == "=" || token == "operator" || (token == ":" && called)) ready = false;
      if (token == "<" && ready && i > from && (is_name(tokens_[i - 1]))) {
        i = after_angles(i) - 1;
      } else if (token == "(") {
        const bool named = ready && i > from && is_function_name(tokens_[i - 1]);
        if (named) function = i - 1;
        ready = ready && !named;
        called = true;
        i = after_bracket(tokens_, i) - 1;
      } else if (token == "[") {
        i = after_bracket(tokens_, i) - 1;
      } else if (token == "{") {
        if (holds_declarations(from, i)) {
          use(from, i);
          return i + 1;
        }
        i = after_bracket(tokens_, i) - 1;
        if (function > 0 && !initialises_member(from, i)) break;
      }
    }
    i = std::min(i + 1, tokens_.size());
    use(from, i);
    if (function == 0) return i;
    const bool overrides =
        std::find(tokens_.begin() + static_cast<std::ptrdiff_t>(from), tokens_.begin() + static_cast<std::ptrdiff_t>(i),
                  "override") != tokens_.begin() + static_cast<std::ptrdiff_t>(i);
    if (!overrides) {
      names_.declared.insert(tokens_[function]);
      --names_.used[tokens_[function]];
    }
    return i;
  }

  // True if the } at `end` closes the initialiser of a constructor's member: a comma or a body follows.
  bool initialises_member(std::size_t from, std::size_t end) const {
    const bool has_list = std::find(tokens_.begin() + static_cast<std::ptrdiff_t>(from),
                                    tokens_.begin() + static_cast<std::ptrdiff_t>(end),
                                    ":") != tokens_.begin() + static_cast<std::ptrdiff_t>(end);
    return has_list && end + 1 < tokens_.size() && (tokens_[end + 1] == "," || tokens_[end + 1] == "{");
  }

  const Tokens& tokens_;
  FunctionNames names_;
};

}  // namespace

FunctionNames function_names_of(std::string_view source) {
  constexpr std::string_view kDefine = "\n#define ";
  const Tokens tokens = tokens_of(source);
  FunctionNames names = NameReader(tokens).read();
  // the text of macros
  for (std::size_t at = source.find(kDefine); at != std::string_view::npos; at = source.find(kDefine, at)) {
    at += kDefine.size();
    std::size_t end = source.find('\n', at);
    while (end != std::string_view::npos && source[end - 1] == '\\') end = source.find('\n', end + 1);
    for (const std::string& token : tokens_of(source.substr(at, end - at))) {
      if (is_name(token)) ++names.used[token];
    }
  }
  return names;
}

}  // namespace afm::support
