// SPDX-License-Identifier: Apache-2.0
#include "core/file_kind.h"

#include <gmock/gmock.h>

#include <string>

namespace afm::core {
namespace file_kind_test {

std::string name_of(std::string_view bytes) {
  const auto kind = file_kind(bytes, bytes.size());
  return kind ? std::string(kind->name) : "";
}

TEST(FileKinds, AreRecognisedByTheirBeginning) {
  EXPECT_EQ(name_of("\x1F\x8B\x08"), "a gzip file");
  EXPECT_EQ(name_of("WSxM file copyright"), "a file of WSxM");
  EXPECT_EQ(name_of("AFMS\x16"), "a session of TouchAFM (.afms)");
  EXPECT_EQ(name_of("Gwyddion Simple Field 1.0\r\nXRes = 2\r\n"), "a .gsf that was copied as a text");
  EXPECT_EQ(name_of("ONTMATRX0101"), "a file of Omicron (.mtrx)");
  EXPECT_EQ(name_of(std::string(257, '\0') + "ustar"), "a tar archive");
  EXPECT_EQ(name_of("\xEF\xBB\xBF\n <!doctype HTML>"), "an HTML page, probably in place of a download");
  EXPECT_EQ(name_of("# two\n# lines\nv 0 0 0\n"), "an OBJ file");
  EXPECT_EQ(name_of("IGOR\nWAVES\tz"), "a text wave of Igor (.itx)");
  EXPECT_EQ(name_of("PK\x03\x04" + std::string(26, '\0') + "[Content_Types].xml"),
            "a file of Excel or another Office program");
  EXPECT_EQ(name_of(""), "an empty file");
  const std::string utf16(
      "h\0e\0i\0g\0h\0t\0 \0f\0o\0r\0c\0e\0\n\0"
      "0\0 \0"
      "1\0",
      32);
  EXPECT_EQ(name_of(utf16), "a text in UTF-16");
  EXPECT_EQ(name_of(utf16.substr(31) + utf16.substr(0, 31)), "a text in UTF-16") << "the higher byte first";
  for (const char* other : {"x", "height force\n0 1\n", "{\"asset\": {}}", "glTF\x02", "#", "####\n\n"})
    EXPECT_EQ(name_of(other), "") << other;
}

// The header may be any text: the number of triangles must match the file's size, and only the beginning is read.
TEST(FileKinds, ABinaryStlIsRecognisedByItsSize) {
  std::string header(84, 'x');
  header.replace(80, 4, std::string("\x02\x01\0\0", 4));
  EXPECT_EQ(file_kind(header, 84 + 50 * 258)->name, "an STL file");
  EXPECT_FALSE(file_kind(header, 84 + 50 * 258 + 1));
  EXPECT_FALSE(file_kind(header.substr(0, 83), 84 + 50 * 258));
}

TEST(FileKinds, HaveARemedyForEveryReader) {
  EXPECT_EQ(remedy_of(file_kind("Rar!\x1A\x07", 6)->role), "unpack it first");
  EXPECT_EQ(remedy_of(file_kind("\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", 8)->role), "save its table as .csv");
  EXPECT_EQ(remedy_of(file_kind("%PDF-1.7", 8)->role), "");
}

}  // namespace file_kind_test
}  // namespace afm::core
