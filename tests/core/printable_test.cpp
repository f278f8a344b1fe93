// SPDX-License-Identifier: Apache-2.0
// Invariant: no text from a file or a device controls a terminal or adds a line to a log, table or other file
#include "core/printable.h"

#include <gtest/gtest.h>

#include <string_view>

namespace afm::core {
namespace printable_test {

using namespace std::string_view_literals;

TEST(Printable, LeavesWhatAPersonCanRead) {
  EXPECT_EQ(printable("Touch\t3.3 N\n"), "Touch\t3.3 N\n");
  EXPECT_EQ(printable("µm · Å 力 🙂"), "µm · Å 力 🙂");
  EXPECT_EQ(printable(""), "");
}

TEST(Printable, ReplacesEscapesAndOtherControls) {
  EXPECT_EQ(printable("a\x1b[2Jb"), "a\uFFFD[2Jb");
  EXPECT_EQ(printable("a\0\r\x7f"sv), "a\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\uFFFD\uFFFD31m")
      << "the 8-bit form of ESC [";
}

TEST(Printable, MakesOneLineOfSeveral) {
  EXPECT_EQ(printable_line("a channel \"heig\nht\"\x1b"), "a channel \"heig ht\"\uFFFD");
}

TEST(Printable, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(printable("\xB5m"), "\uFFFDm") << "Latin-1";
  EXPECT_EQ(printable("\xC0\xAF"), "\uFFFD\uFFFD") << "longer than needed";
  EXPECT_EQ(printable("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD") << "a surrogate";
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD") << "beyond Unicode";
  EXPECT_EQ(printable("\xE5\x8A"), "\uFFFD\uFFFD") << "cut short";
}

}  // namespace printable_test
}  // namespace afm::core
