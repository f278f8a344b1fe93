// SPDX-License-Identifier: Apache-2.0
#include "scene/config/toml_file.h"

#include <gmock/gmock.h>

#include <string>

#include "support/scratch_folder.h"

namespace afm::scene {
namespace toml_file_test {

using ::testing::HasSubstr;

std::string outcome(const std::string& text) {
  const support::ScratchFolder folder;
  const auto root = parse_toml("test file", folder.write("a.toml", text));
  return root ? "read" : root.error().message;
}

std::string dotted(int parts) {
  std::string key = "a";
  for (int i = 1; i < parts; ++i) key += ".a";
  return key;
}

// Each of these keys once ended the program: 100 kB suffice to fill the stack.
TEST(TomlFile, RefusesKeysThatWouldFillTheStack) {
  const std::string deep = dotted(50'000);
  for (const std::string& text : {deep + " = 1", "[" + deep + "]", "[[" + deep + "]]", "b = { " + deep + " = 1 }",
                                  "[ \"a\" . " + deep + "]", "b = [{ c = 1 }, { " + deep + " = 1 }]"}) {
    EXPECT_THAT(outcome("x = 1\n\n" + text + "\n"), HasSubstr("a.toml: line 3: a key has more than 16 parts"));
  }
}

TEST(TomlFile, CountsThePartsOfKeysAlone) {
  EXPECT_EQ(outcome(dotted(16) + " = 1"), "read");
  EXPECT_THAT(outcome(dotted(17) + " = 1"), HasSubstr("line 1: a key has more than 16 parts"));
  const std::string dots(100, '.');
  for (const std::string& text :
       {"a = \"" + dots + "\"", "a = '" + dots + "' # " + dots, "a = \"\\\"" + dots + "\"",
        "a = \"\"\"\n" + dots + "\\\n\"" + dots + "\"\"\"", "\"" + dots + "\" = 1",
        std::string("a = [1.5, 2.5, 3.5,\n 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5, 16.5]")}) {
    EXPECT_EQ(outcome(text), "read") << text;
  }
}

TEST(TomlFile, RefusesWhatNoPersonWrites) {
  EXPECT_THAT(outcome(std::string((4U << 20U) + 1, '\n')), HasSubstr("a.toml: is larger than 4 MiB"));
}

TEST(TomlFile, SaysWhatIsWrongInOneLine) {
  const std::string said = outcome("a = tr\nb = 1\n");
  EXPECT_THAT(said, HasSubstr("a.toml: line 1: "));
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
}

TEST(TomlFile, NamesAFileInAnotherEncodingOrNoTextAtAll) {
  const std::string utf16 = std::string("\xFF\xFE") + "a";
  EXPECT_THAT(outcome(utf16), HasSubstr("a.toml: it is a text in UTF-16; save it in UTF-8"));
  EXPECT_THAT(outcome("a = \"W\xE4nde\"\n"), HasSubstr("; save the file in UTF-8"));
  EXPECT_THAT(outcome("<!DOCTYPE html><html>"), HasSubstr("it is an HTML page"));
  EXPECT_THAT(outcome("\x1F\x8B\x08"), HasSubstr("it is a gzip file; unpack it first"));
  EXPECT_THAT(outcome("%PDF-1.7"), HasSubstr("it is a PDF document; save it as plain text in UTF-8"));
  EXPECT_EQ(outcome("g = 1\n"), "read");
  EXPECT_EQ(outcome(""), "read");
}

// Texts go into lines: of a log, and of a curve file, where another line would be a sample.
TEST(TomlFile, RefusesTextsOfSeveralLinesAndControlCharacters) {
  for (const char* text : {"\"\"\"c\nd\"\"\"", "\"c\\nd\"", "[{ c = \"\\u001b[2J\" }]", "\"c\\td\"", "\"\\u009b\""}) {
    EXPECT_THAT(outcome(std::string("a = 'a'\nb = ") + text + "\n"),
                HasSubstr("a.toml: line 2: a text contains a line end, a tab or another control character"))
        << text;
  }
  EXPECT_EQ(outcome("a = 'µm · Å'\nb = \"\"\"\none line\"\"\"\n"), "read");
}

TEST(TomlFile, LeavesUnfinishedStringsToTheParser) {
  for (const char* text : {"a = \"", "a = '", "a = \"\"\"", "a = '''x", "a = \"\\", "a = \"\n.\""}) {
    EXPECT_THAT(outcome(text), HasSubstr("a.toml: line ")) << text;
  }
}

}  // namespace toml_file_test
}  // namespace afm::scene
