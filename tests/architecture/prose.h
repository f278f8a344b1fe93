// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace afm::support {

// Text for people, with the line of the file that each character comes from.
struct Prose {
  std::string text;
  std::vector<int> lines;  // line of each character

  void add(std::string_view piece, int line);
};

// Every string literal of a C++ source that holds more than one word; adjacent literals are one. Comments, included
// files and literals of one word (keys, names) are left out.
std::vector<Prose> messages_of(std::string_view source);

struct Comment {
  std::string text;
  int line = 1;
};

// Every // comment of a C++ or GLSL source that follows code on its line, without the slashes. Block comments, and
// continuations on the next line, are left out.
std::vector<Comment> trailing_comments_of(std::string_view source);

// Every // comment of a C++ or GLSL source; comments on adjacent lines are one.
std::vector<Prose> comments_of(std::string_view source);

// The names of the tests that a source defines, suite and case, as words: "Jump To Contact: Happens Before Touch".
std::vector<Prose> test_names_of(std::string_view source);

// A page as one text, so that a phrase is found across the end of a line. Inline code of one word is left out.
Prose page_of(std::string_view document);

// Lines on which the word or phrase occurs: whole words, in any case.
std::vector<int> lines_with(const Prose& prose, std::string_view phrase);

}  // namespace afm::support
