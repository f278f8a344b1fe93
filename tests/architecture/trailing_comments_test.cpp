// SPDX-License-Identifier: Apache-2.0
// Trailing comments can be read alone: they do not begin with a preposition or a relative pronoun. Comments above
// production code begin with a noun or a verb.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "architecture/production.h"
#include "architecture/prose.h"
#include "core/whole_file.h"
#include "support/places.h"

namespace afm {
namespace trailing_comments_test {

using support::Comment;
using support::trailing_comments_of;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::array<std::string_view, 11> kDependent{"of",    "that",    "for",      "until", "which", "who",
                                                      "where", "whether", "likewise", "what",  "how"};
constexpr std::array<std::string_view, 3> kQuestions{"What ", "How ", "Whether "};

bool is_dependent(const Comment& comment) {
  const std::string first = comment.text.substr(0, comment.text.find_first_of(" ,.:;"));
  return std::any_of(kDependent.begin(), kDependent.end(), [&](std::string_view word) {
    return std::equal(first.begin(), first.end(), word.begin(), word.end(), [](char a, char b) {
      return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    });
  });
}

// "line: text" for each.
std::vector<std::string> faults_of(std::string_view source) {
  std::vector<std::string> faults;
  for (const Comment& comment : trailing_comments_of(source)) {
    if (is_dependent(comment)) faults.push_back(fmt::format("{}: {}", comment.line, comment.text));
  }
  return faults;
}

// Files of C++ and GLSL below these folders.
std::vector<std::filesystem::path> sources_below(const std::set<std::string>& roots) {
  namespace fs = std::filesystem;
  constexpr std::array<std::string_view, 6> kEndings{".cpp", ".h", ".glsl", ".vert", ".frag", ".comp"};
  std::vector<fs::path> sources;
  for (const std::string& root : roots) {
    for (const auto& entry : fs::recursive_directory_iterator(support::source(root))) {
      const std::string ending = entry.path().extension().string();
      const bool is_source = std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
      if (entry.is_regular_file() && is_source) sources.push_back(entry.path());
    }
  }
  return sources;
}

std::string in_tree(const std::filesystem::path& path) {
  return std::filesystem::relative(path, support::source()).string();
}

TEST(TrailingComments, AreFoundWithTheirLines) {
  const auto comments = trailing_comments_of(
      "// a comment of its line\n"
      "int a = 1;  // of the first\n"
      "const char* b = \"no // comment\";\n"
      "int c = 1'000;   //   seconds\n"
      "/* int d;  // inside */ char e = '\"';  // a quote\n");
  ASSERT_EQ(comments.size(), 3U);
  EXPECT_EQ(comments[0].text, "of the first");
  EXPECT_EQ(comments[0].line, 2);
  EXPECT_EQ(comments[1].text, "seconds");
  EXPECT_EQ(comments[2].text, "a quote");
}

TEST(TrailingComments, ThatDependOnTheirLineAreNoticed) {
  EXPECT_THAT(faults_of("int a;  // of the lever\nint b;  // Likewise\nint c;  // likewise, later\n"),
              ElementsAre("1: of the lever", "2: Likewise", "3: likewise, later"));
  EXPECT_THAT(faults_of("int a;  // offset in metres\nint b;  // whole steps\n// of a block\nint c;\n"), IsEmpty());
}

TEST(TrailingComments, CanBeReadAlone) {
  std::vector<std::string> faults;
  std::set<std::string> roots = support::production_folders();
  roots.insert({"assets", "shaders", "tests"});
  const auto sources = sources_below(roots);
  for (const auto& path : sources) {
    for (const std::string& fault : faults_of(core::read_file(path.string()).value())) {
      faults.push_back(in_tree(path) + ":" + fault);
    }
  }
  EXPECT_GT(sources.size(), 1200U);
  EXPECT_THAT(faults, IsEmpty());
}

TEST(Comments, AboveProductionCodeBeginWithANounOrAVerb) {
  std::vector<std::string> faults;
  std::size_t comments = 0;
  for (const auto& path : sources_below(support::production_folders())) {
    for (const support::Prose& comment : support::comments_of(core::read_file(path.string()).value())) {
      ++comments;
      const bool asks = std::any_of(kQuestions.begin(), kQuestions.end(),
                                    [&](std::string_view word) { return comment.text.starts_with(word); });
      if (asks) faults.push_back(fmt::format("{}:{}: {}", in_tree(path), comment.lines.front(), comment.text));
    }
  }
  EXPECT_GT(comments, 8000U);
  EXPECT_THAT(faults, IsEmpty());
}

}  // namespace trailing_comments_test
}  // namespace afm
