// SPDX-License-Identifier: Apache-2.0
#include "scene/config/toml_table.h"

#include <gmock/gmock.h>

#include <array>
#include <functional>
#include <string>
#include <string_view>

#include "scene/config/toml_file.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace toml_table_test {

using ::testing::EndsWith;
using ::testing::HasSubstr;

using Read = std::function<void(const TomlTable&)>;

// Message about a file whose root is read by `read`; "read" if there is none.
std::string outcome(const std::string& text, const Read& read) {
  const support::ScratchFolder folder;
  const auto done = read_toml("test file", folder.write("a.toml", text), [&](const toml::table& root) {
    read(TomlTable(root));
    return 0;
  });
  return done ? "read" : done.error().message;
}

struct Row {
  int number;
  std::string_view word;
};
constexpr std::array kRows{Row{1, "one"}, Row{2, "two"}};

TEST(TomlTable, NamesLineKeyAndWhatWasExpected) {
  struct Case {
    const char* value;
    Read read;
    const char* said;
  };
  const Case cases[] = {
      {"3", [](const TomlTable& t) { t.text("key"); }, "must be text and not empty"},
      {"\"\"", [](const TomlTable& t) { t.text("key", 9); }, "must be text of 1 to 9 bytes in quotes"},
      {"[\"a\", \"a\"]", [](const TomlTable& t) { t.texts("key", 3); }, "must be a list of texts, each of them once"},
      {"1", [](const TomlTable& t) { t.flag("key"); }, "must be true or false"},
      {"1.0", [](const TomlTable& t) { t.whole("key", 1, 2); }, "must be a whole number from 1 to 2"},
      {"nan", [](const TomlTable& t) { t.number("key", 1, 2); }, "must be a number from 1 to 2"},
      {"3", [](const TomlTable& t) { t.number("key", 1, 2, "a ratio"); }, "must be a number from 1 to 2, a ratio"},
      {"[1, inf]", [](const TomlTable& t) { t.numbers<2>("key", "two numbers"); }, "must be two numbers"},
      {"[1, 2]", [](const TomlTable& t) { t.point("key"); }, "must be three numbers [x, y, z] in metres"},
      {"[1, 0, 0, 1]", [](const TomlTable& t) { t.rotation("key"); }, "must be a unit quaternion [x, y, z, w]"},
      {"\"5 N\"", [](const TomlTable& t) { t.quantity("key", physics::kLengthUnits); }, "m, mm, um, nm, pm"},
      {"0.05", [](const TomlTable& t) { t.quantity("key", physics::kLengthUnits); },
       "\"0.05\" as a length: it has no unit"},
      {"\"six\"", [](const TomlTable& t) { t.one_of("key", kRows, &Row::word); }, "six is unknown; known are one, two"},
      {"3", [](const TomlTable& t) { t.table("key", "[key]"); }, "must be written [key]"},
      {"[]", [](const TomlTable& t) { t.tables("key"); }, "must be written [[key]]"},
      {"[{}, 3]", [](const TomlTable& t) { t.tables("key"); }, "must be written [[key]]"},
      {"[{}, {}]", [](const TomlTable& t) { t.tables("key", 1); }, "the file has more than 1 of them"},
  };
  for (const Case& each : cases) {
    EXPECT_THAT(outcome("\nkey = " + std::string(each.value) + "\n", each.read),
                AllOf(HasSubstr("a.toml: line 2: key: "), HasSubstr(each.said)));
    EXPECT_THAT(outcome("other = 1\n", each.read), HasSubstr("key: is missing"));
  }
}

TEST(TomlTable, ReadsWhatIsAsExpected) {
  const std::string text =
      "word = \"two\"\nlength = \"5 nm\"\nturn = [0, 0, 1.0005, 0]\n[inner]\nwhole = 3\n[[row]]\nflag = "
      "true\n[[row]]\n";
  const Read read = [](const TomlTable& t) {
    EXPECT_EQ(t.one_of("word", kRows, &Row::word).number, 2);
    EXPECT_DOUBLE_EQ(t.quantity("length", physics::kLengthUnits).si, 5e-9);
    EXPECT_DOUBLE_EQ(t.rotation("turn").z, 1.0);
    EXPECT_EQ(t.table("inner", "[inner]").whole("whole", 0, 3), 3);
    ASSERT_EQ(t.tables("row").size(), 2U);
    EXPECT_TRUE(t.tables("row").front().flag("flag"));
  };
  EXPECT_EQ(outcome(text, read), "read");
}

TEST(TomlTable, NamesTheTablesAboveAKey) {
  EXPECT_THAT(outcome("[a]\n[a.b]\n", [](const TomlTable& t) { t.table("a", "[a]").table("b", "[a.b]").text("c"); }),
              EndsWith("line 2: a.b.c: is missing"));
  EXPECT_THAT(outcome("[[a]]\n[[a]]\nb = 1\n", [](const TomlTable& t) { t.tables("a").back().text("b"); }),
              EndsWith("line 3: a.b: must be text and not empty, in quotes"));
}

TEST(TomlTable, RefusesKeysThatItDoesNotKnow) {
  const std::string text = "a = 1\nb = 2\n";
  EXPECT_EQ(outcome(text, [](const TomlTable& t) { t.allow_only({"a", "b"}); }), "read");
  EXPECT_THAT(outcome(text, [](const TomlTable& t) { t.allow_only({"a", "c"}); }),
              EndsWith("line 2: b: unknown key; known are a, c"));
  EXPECT_THAT(outcome(text, [](const TomlTable& t) { t.allow_only({"a"}); }),
              EndsWith("line 2: b: unknown key; known is a"));
}

}  // namespace toml_table_test
}  // namespace afm::scene
