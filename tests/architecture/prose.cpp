// SPDX-License-Identifier: Apache-2.0
#include "architecture/prose.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace afm::support {

namespace {

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Reads the tokens of a C++ source that matter here: literals, comments, and everything else.
class SourceReader {
 public:
  explicit SourceReader(std::string_view source) : source_(source) {}

  std::vector<Prose> messages() {
    while (at_ < source_.size()) step();
    end_message();
    return std::move(messages_);
  }

  std::vector<Comment> trailing_comments() {
    messages();
    return std::move(trailing_comments_);
  }

  std::vector<Prose> comments() {
    messages();
    return std::move(comments_);
  }

 private:
  bool follows(std::string_view text) const { return source_.substr(at_).starts_with(text); }

  void skip(std::size_t count) {
    const std::string_view skipped = source_.substr(at_, count);
    line_ += static_cast<int>(std::count(skipped.begin(), skipped.end(), '\n'));
    at_ += skipped.size();
  }

  // Up to the text and beyond it; the whole rest if it does not come.
  void skip_past(std::string_view text) {
    const std::size_t found = source_.find(text, at_);
    skip(found == std::string_view::npos ? source_.size() - at_ : found + text.size() - at_);
  }

  void step() {
    const char c = source_[at_];
    if (follows("//")) return read_comment();
    if (c == '#' && follows("#include")) return skip_past("\n");
    if (follows("/*")) return skip_past("*/");
    if (follows("R\"")) return read_raw_literal();
    if (c == '"') return read_literal();
    if (is_space(c)) return skip(1);  // blank between adjacent literals
    end_message();
    // a digit's separator is no character literal
    if (c == '\'' && !(at_ > 0 && is_letter(source_[at_ - 1]))) {
      skip(source_.substr(at_, 2) == "'\\" ? 3 : 1);
      return skip_past("'");
    }
    skip(1);
  }

  void read_comment() {
    const std::size_t begin = source_.rfind('\n', at_) == std::string_view::npos ? 0 : source_.rfind('\n', at_) + 1;
    const std::string_view before = source_.substr(begin, at_ - begin);
    const std::string_view line = source_.substr(at_, source_.find('\n', at_) - at_);
    const auto text = std::find_if_not(line.begin() + 2, line.end(), is_space);
    if (!std::all_of(before.begin(), before.end(), is_space)) {
      trailing_comments_.push_back({.text = std::string(text, line.end()), .line = line_});
    }
    const bool continues = !comments_.empty() && comments_.back().lines.back() == line_ - 1;
    Prose& comment = continues ? comments_.back() : comments_.emplace_back();
    comment.add(std::string(text, line.end()) + " ", line_);
    skip_past("\n");
  }

  void read_literal() {
    skip(1);
    while (at_ < source_.size() && source_[at_] != '"') {
      const bool escaped = source_[at_] == '\\';
      if (escaped) skip(1);
      const char c = at_ < source_.size() ? source_[at_] : ' ';
      message_.add(escaped && c == 'n' ? " " : std::string_view(&c, 1), line_);
      skip(1);
    }
    skip(1);
  }

  void read_raw_literal() {
    const std::size_t open = source_.find('(', at_);
    const std::string end = ")" + std::string(source_.substr(at_ + 2, open - at_ - 2)) + "\"";
    skip(open + 1 - at_);
    while (at_ < source_.size() && !follows(end)) {
      message_.add(source_.substr(at_, 1), line_);
      skip(1);
    }
    skip(end.size());
  }

  void end_message() {
    const std::string& text = message_.text;
    const auto word = std::find_if_not(text.begin(), text.end(), is_space);
    if (std::find_if(word, text.end(), is_space) != text.end()) messages_.push_back(message_);
    message_ = {};
  }

  std::string_view source_;
  std::size_t at_ = 0;
  int line_ = 1;
  Prose message_;
  std::vector<Prose> messages_;
  std::vector<Comment> trailing_comments_;
  std::vector<Prose> comments_;
};

}  // namespace

void Prose::add(std::string_view piece, int line) {
  for (const char c : piece) {
    // one space between words, regardless of line breaks
    if (is_space(c) && !text.empty() && text.back() == ' ') continue;
    text += is_space(c) ? ' ' : c;
    lines.push_back(line);
  }
}

std::vector<Prose> messages_of(std::string_view source) { return SourceReader(source).messages(); }

std::vector<Comment> trailing_comments_of(std::string_view source) { return SourceReader(source).trailing_comments(); }

std::vector<Prose> comments_of(std::string_view source) { return SourceReader(source).comments(); }

std::vector<Prose> test_names_of(std::string_view source) {
  std::vector<Prose> names;
  int line = 0;
  for (std::size_t at = 0; at < source.size(); at = source.find('\n', at) + 1) {
    ++line;
    const std::string_view rest = source.substr(at);
    if (rest.starts_with("TEST(") || rest.starts_with("TEST_F(") || rest.starts_with("TEST_P(")) {
      Prose& name = names.emplace_back();
      for (const char c : rest.substr(rest.find('(') + 1, rest.find(')') - rest.find('(') - 1)) {
        if (std::isupper(static_cast<unsigned char>(c)) != 0) name.add(" ", line);
        name.add(c == ',' ? ":" : std::string_view(&c, 1), line);
      }
    }
    if (source.find('\n', at) == std::string_view::npos) break;
  }
  return names;
}

Prose page_of(std::string_view document) {
  Prose page;
  int line = 1;
  for (std::size_t at = 0; at < document.size(); ++at) {
    if (document[at] == '`') {
      const std::string_view code = document.substr(at + 1, document.find('`', at + 1) - at - 1);
      if (!code.empty() && std::none_of(code.begin(), code.end(), is_space)) at += code.size() + 1;
    }
    page.add(document.substr(at, 1), line);
    if (document[at] == '\n') ++line;
  }
  return page;
}

std::vector<int> lines_with(const Prose& prose, std::string_view phrase) {
  const auto same = [](char a, char b) { return lower(a) == lower(b); };
  std::vector<int> found;
  for (auto at = prose.text.begin();; ++at) {
    at = std::search(at, prose.text.end(), phrase.begin(), phrase.end(), same);
    if (at == prose.text.end()) return found;
    const auto end = at + static_cast<std::ptrdiff_t>(phrase.size());
    const bool whole =
        (at == prose.text.begin() || !is_letter(at[-1])) && (end == prose.text.end() || !is_letter(*end));
    if (whole) found.push_back(prose.lines[static_cast<std::size_t>(at - prose.text.begin())]);
  }
}

}  // namespace afm::support
