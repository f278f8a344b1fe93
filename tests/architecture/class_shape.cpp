// SPDX-License-Identifier: Apache-2.0
#include "architecture/class_shape.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "architecture/tokens.h"

namespace afm::support {

namespace {

// A declaration in a class, up to the place that has been read.
struct Declaration {
  std::string first;       // first word
  int commas = 0;          // number between declarators
  int angles = 0;          // number of open angle brackets
  bool call = false;       // true: parameters of a function
  bool value = false;      // true: part after =
  bool fixed = false;      // true: static
  bool operation = false;  // true: operator
  bool members = false;    // true: initialisers of a constructor
};

void count(const Declaration& declaration, ClassShape& shape) {
  constexpr std::array<std::string_view, 8> kOthers{"using", "friend", "typedef", "static_assert",
                                                    "enum",  "class",  "struct",  "union"};
  if (declaration.first.empty()) return;
  if (declaration.call && declaration.first != "friend" && declaration.first != "static_assert" &&
      declaration.first != "using") {
    ++shape.functions;
  } else if (!declaration.fixed && std::find(kOthers.begin(), kOthers.end(), declaration.first) == kOthers.end()) {
    shape.fields += 1 + declaration.commas;
  }
}

class ClassReader {
 public:
  explicit ClassReader(const Tokens& tokens) : tokens_(tokens) {}

  std::vector<ClassShape> read() {
    for (std::size_t i = 0; i < tokens_.size();) {
      if (const std::size_t body = body_of_class(i); body > 0) {
        i = read_body(name_before(i, body), body);
      } else if (tokens_[i] == "{" && !opens_namespace(i)) {
        i = after_bracket(tokens_, i);
      } else {
        ++i;
      }
    }
    return std::move(shapes_);
  }

 private:
  // Index of the { of a class whose definition begins at `at`; 0: none does.
  std::size_t body_of_class(std::size_t at) const {
    if (tokens_[at] != "class" && tokens_[at] != "struct") return 0;
    if (at > 0 && (tokens_[at - 1] == "enum" || tokens_[at - 1] == "<" || tokens_[at - 1] == ",")) return 0;
    for (std::size_t i = at + 1; i < tokens_.size(); ++i) {
      if (tokens_[i] == "{") return i;
      if (tokens_[i] == ";" || tokens_[i] == "(" || tokens_[i] == ")" || tokens_[i] == "=") return 0;
    }
    return 0;
  }

  // The last name before the base classes, `final`, the arguments of a specialisation or the body.
  std::string name_before(std::size_t at, std::size_t body) const {
    std::string name;
    for (std::size_t i = at + 1; i < body; ++i) {
      if (tokens_[i] == ":" || tokens_[i] == "<" || tokens_[i] == "final") break;
      if (is_name(tokens_[i])) name = tokens_[i];
    }
    return name;
  }

  bool opens_namespace(std::size_t brace) const {
    for (std::size_t i = brace; i > 0; --i) {
      const std::string& token = tokens_[i - 1];
      if (token == "namespace") return true;
      if (token != "::" && !is_name(token)) return false;
    }
    return false;
  }

  // Reads the members from the { at `at`; returns the index after its }.
  std::size_t read_body(const std::string& name, std::size_t at) {
    ClassShape shape{.name = name};
    Declaration now;
    std::size_t i = at + 1;
    while (i < tokens_.size() && tokens_[i] != "}") {
      if (now.first.empty()) {
        if (const std::size_t body = body_of_class(i); body > 0) {
          i = read_body(name_before(i, body), body);
          while (i < tokens_.size() && tokens_[i] != ";") ++i;
          ++i;
          continue;
        }
      }
      i = read_token(i, now, shape);
    }
    shapes_.push_back(std::move(shape));
    return i + 1;
  }

  std::size_t read_token(std::size_t i, Declaration& now, ClassShape& shape) const {
    const std::string& token = tokens_[i];
    const bool inside = now.angles > 0;
    if (token == ";") {
      count(now, shape);
      now = {};
    } else if (token == "[") {
      return after_bracket(tokens_, i);
    } else if (token == "(") {
      const std::string& before = tokens_[i - 1];
      if (!inside && !now.value && before != "alignas" && before != "decltype") now.call = true;
      return after_bracket(tokens_, i);
    } else if (token == "{") {
      return read_brace(i, now, shape);
    } else if (token == ":" && (now.first == "public" || now.first == "private" || now.first == "protected")) {
      now = {};
    } else if (token == ":") {
      now.members = now.call;
    } else if (token == "=" && (!now.operation || now.call)) {
      now.value = now.value || !inside;
    } else if (token == "<" && !now.value && (!now.operation || now.call)) {
      ++now.angles;
    } else if (token == ">" && inside) {
      --now.angles;
    } else if (token == "," && !inside && !now.call) {
      ++now.commas;
    } else if (is_name(token)) {
      if (now.first == "template" && !inside) now.first = token;
      if (now.first.empty()) now.first = token;
      now.fixed = now.fixed || token == "static";
      now.operation = now.operation || token == "operator";
    }
    return i + 1;
  }

  // The body of a function ends its declaration; other braces hold a value, or the enumerators of an enum.
  std::size_t read_brace(std::size_t i, Declaration& now, ClassShape& shape) const {
    const std::string& before = tokens_[i - 1];
    const bool member = now.members && (is_name(before) || before == ">");
    if (now.call && !now.value && now.angles == 0 && !member) {
      count(now, shape);
      now = {};
    }
    return after_bracket(tokens_, i);
  }

  const Tokens& tokens_;
  std::vector<ClassShape> shapes_;
};

}  // namespace

std::vector<ClassShape> classes_of(std::string_view source) {
  const Tokens tokens = tokens_of(source);
  return ClassReader(tokens).read();
}

std::set<std::string> owners_of_members(std::string_view source) {
  const Tokens tokens = tokens_of(source);
  std::set<std::string> owners;
  bool value = false;  // true: after the = of a declaration
  for (std::size_t i = 0; i < tokens.size();) {
    const std::string& token = tokens[i];
    if (token == "=" && tokens[i - 1] != "operator") value = true;
    if (token == ";" || token == "}") value = false;
    if (token == "(" || token == "[") {
      i = after_bracket(tokens, i);
      continue;
    }
    if (token == "{") {
      // skips all braces except those of namespaces
      std::size_t name = i;
      while (name > 0 && (tokens[name - 1] == "::" || (is_name(tokens[name - 1]) && tokens[name - 1] != "namespace")))
        --name;
      const bool space = name > 0 && tokens[name - 1] == "namespace";
      i = space ? i + 1 : after_bracket(tokens, i);
      value = value && !space;
      continue;
    }
    if (!value && token == "::" && i > 0 && is_name(tokens[i - 1])) {
      std::string owner = tokens[i - 1];
      for (std::size_t at = i - 1; at >= 2 && tokens[at - 1] == "::" && is_name(tokens[at - 2]); at -= 2) {
        owner.insert(0, tokens[at - 2] + "::");
      }
      std::size_t end = i + 1;
      if (end < tokens.size() && tokens[end] == "operator") {
        while (end < tokens.size() && tokens[end] != "(") ++end;
        owners.insert(owner);
      } else {
        if (end < tokens.size() && tokens[end] == "~") ++end;
        if (end + 1 < tokens.size() && is_name(tokens[end]) && tokens[end + 1] == "(") owners.insert(owner);
      }
    }
    ++i;
  }
  return owners;
}

}  // namespace afm::support
