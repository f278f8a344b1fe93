// SPDX-License-Identifier: Apache-2.0
#include "curves/image_output.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

namespace image_output_test {

using namespace afm::curves;
using afm::physics::ScanImage;

// The field of the rows A30 to A32.
ScanImage field_of_the_table() {
  ScanImage image;
  image.columns = 3;
  image.rows = 2;
  image.width_m = 3e-6;
  image.height_m = 2e-6;
  image.channels = {{"Height", "m", {0.0, 1e-9, 2e-9, 3e-9, 4e-9, 5e-9}}};
  return image;
}

TEST(GwyddionSimpleField, A30HasTheBytesOfTheTable) {
  const std::string bytes = gsf_bytes(field_of_the_table(), 0);
  EXPECT_EQ(bytes.size(), 136U);
  EXPECT_EQ(bytes.find('\0'), 110U);
  EXPECT_EQ(bytes.substr(110, 2), std::string(2, '\0'));
  EXPECT_NE(bytes[112 + 5], '\0') << "the second value begins right behind";
}

TEST(GwyddionSimpleField, A31IsTheFileOfTheTable) {
  std::string expected =
      "Gwyddion Simple Field 1.0\nXRes = 3\nYRes = 2\nXReal = 3e-06\nYReal = 2e-06\nXYUnits = m\nZUnits = m\n"
      "Title = Height\n";
  expected.append(2, '\0');
  for (int i = 0; i < 6; ++i) {
    const float value = static_cast<float>(i * 1e-9);
    char raw[4];
    std::memcpy(raw, &value, 4);
    expected.append(raw, 4);
  }
  EXPECT_EQ(gsf_bytes(field_of_the_table(), 0), expected);
}

TEST(GwyddionSimpleField, IsPaddedByOneToFourBytes) {
  ScanImage image = field_of_the_table();
  for (int i = 0; i < 8; ++i) {
    image.channels[0].name += 'x';
    const std::string bytes = gsf_bytes(image, 0);
    const std::size_t header = bytes.find('\0'), padding = bytes.size() - 24 - header;
    EXPECT_EQ((header + padding) % 4, 0U);
    EXPECT_GE(padding, 1U);
    EXPECT_LE(padding, 4U);
  }
}

TEST(GwyddionSimpleField, KeepsMetadataFromBreakingItsHeader) {
  ScanImage image = field_of_the_table();
  image.x_offset_m = -1e-6;
  image.metadata = {{"setpoint", "500 pN"}, {"a=b\nXRes", "1\nYRes = 7"}, {"XRes", "9"}};
  const std::string header = gsf_bytes(image, 0);
  EXPECT_NE(header.find("YReal = 2e-06\nXOffset = -1e-06\nXYUnits = m\n"), std::string::npos);
  EXPECT_NE(header.find("Title = Height\nsetpoint = 500 pN\na b XRes = 1 YRes = 7\n"), std::string::npos);
  EXPECT_EQ(header.find("XRes = 9"), std::string::npos);
  EXPECT_EQ(std::count(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(header.find('\0')), '\n'), 11);
}

TEST(GwyddionFile, A32HasTheBytesOfTheTable) { EXPECT_EQ(gwy_bytes(field_of_the_table()).size(), 278U); }

TEST(GwyddionFile, HoldsEveryChannelWithItsTitleAndTheMetadata) {
  ScanImage image = field_of_the_table();
  image.channels.push_back({"Error (retrace)", "N", {1, 2, 3, 4, 5, 6}});
  image.metadata = {{"Setpoint", "500 pN"}};
  const std::string bytes = gwy_bytes(image);
  EXPECT_EQ(bytes.substr(0, 17), std::string("GWYPGwyContainer\0", 17));
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 17, 4);
  EXPECT_EQ(size, bytes.size() - 21);
  for (const char* channel : {"/0/", "/1/"}) {
    using namespace std::string_literals;
    EXPECT_NE(bytes.find(channel + "data\0oGwyDataField\0"s), std::string::npos);
    EXPECT_NE(bytes.find(channel + "meta\0oGwyContainer\0"s + std::string("\x11\0\0\0", 4) + "Setpoint\0s500 pN\0"s),
              std::string::npos);
  }
  EXPECT_NE(bytes.find(std::string("/1/data/title\0sError (retrace)\0", 31)), std::string::npos);
  EXPECT_NE(bytes.find(std::string("si_unit_z\0oGwySIUnit\0\x0b\0\0\0unitstr\0sN\0", 36)), std::string::npos);
}

TEST(ImageFormat, IsKnownByTheEndingOfAFile) {
  EXPECT_EQ(image_format("a/b.gwy"), ImageFormat::Gwy);
  EXPECT_EQ(image_format("b.gsf"), ImageFormat::Gsf);
  EXPECT_FALSE(image_format("b.png"));
}

}  // namespace image_output_test
