// SPDX-License-Identifier: Apache-2.0
// Images of Park Systems and Nanosurf, put together here byte by byte. The layouts were checked with one public file of
// Park (its preview is the image turned upside down) and two of Nanosurf.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "curves/image_file.h"
#include "damaged_images.h"
#include "support/image_files.h"
#include "vendor_image_files.h"

namespace afm::curves {
namespace vendor_images_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using namespace afm::test;

constexpr double kExact = 1e-21;  // tolerance in metres, for heights of nanometres

LoadedImage loaded(const std::string& bytes, const std::string& channel = {}) {
  auto image = parse_image(bytes, "scan.x", {.channel = channel});
  EXPECT_TRUE(image.has_value()) << image.error().message;
  return image ? std::move(*image) : LoadedImage{};
}

std::string error_of(const std::string& bytes) {
  const auto image = parse_image(bytes, "scan.x");
  return image ? "accepted" : image.error().message;
}

const std::vector<double>& values(const LoadedImage& image) { return image.image.channels.at(image.chosen).values; }

const std::string kNumbers = little_numbers<std::int32_t>({1, 2, 3, 4, 5, 6});

TEST(ParkImage, HasItsGainAndItsRowsFromBottomToTop) {
  const LoadedImage image = loaded(park_image_file({}, kNumbers));
  EXPECT_EQ(image.format, ImageFormat::Park);
  EXPECT_EQ(image.image.columns, 3U);
  EXPECT_EQ(image.image.rows, 2U);
  EXPECT_DOUBLE_EQ(image.image.width_m, 3e-6);
  EXPECT_DOUBLE_EQ(image.image.height_m, 2e-6);
  EXPECT_EQ(image.image.channels.at(0).name, "Z Height");
  EXPECT_EQ(image.image.channels.at(0).unit, "m");
  EXPECT_NEAR(values(image)[0], -0.5e-9 * 4, kExact) << "the first row of the file is the lowest";
  EXPECT_NEAR(values(image)[5], -0.5e-9 * 3, kExact);
  EXPECT_THAT(image.image.metadata, Contains(Pair("Mode", "Tapping")));
  EXPECT_THAT(image.image.metadata, Contains(Pair("Software", "SmartScan")));
  EXPECT_THAT(image.image.metadata, Contains(Pair("Scan rate", "0.2 Hz")));
}

TEST(ParkImage, HasIntegersOfTwoSizesAndFloats) {
  const LoadedImage floats =
      loaded(park_image_file({.number_type = 2, .gain = 2, .scale = 3, .offset = 10, .unit = u"\u00b5m"},
                             little_numbers<float>({0.5F, 0, 0, 0, 0, 0})));
  EXPECT_NEAR(values(floats)[3], 2e-6 * (3 * 0.5 + 10), 1e-18);
  const std::string shorts = little_numbers<std::int16_t>({-7, 0, 0, 0, 0, 0});
  EXPECT_NEAR(values(loaded(park_image_file({.number_type = 0}, shorts)))[3], 3.5e-9, kExact);
  EXPECT_NEAR(values(loaded(park_image_file({}, shorts, 0x01000001)))[3], 3.5e-9, kExact)
      << "the first version has short integers alone";
}

TEST(ParkImage, NamesItsDirectionAndAScanAlongY) {
  const LoadedImage image = loaded(park_image_file({.forward = 0, .swapped = 1, .source = u"H\u00f6he"}, kNumbers));
  EXPECT_EQ(image.image.channels.at(0).name, "H\xc3\xb6he (retrace)");
  EXPECT_THAT(image.remarks, ElementsAre(HasSubstr("scanned along y")));
}

TEST(ParkImage, IsRefusedWhereItIsDamaged) {
  EXPECT_THAT(error_of(park_image_file({.columns = 4}, kNumbers)), HasSubstr("cut short"));
  EXPECT_THAT(error_of(park_image_file({.columns = 1}, kNumbers)), HasSubstr("points on a side: 1"));
  EXPECT_THAT(error_of(park_image_file({.number_type = 3}, kNumbers)), HasSubstr("its numbers are of type 3"));
  EXPECT_THAT(error_of(park_image_file({.gain = 0}, kNumbers)), HasSubstr("no calibration"));
  EXPECT_THAT(error_of(park_image_file({.width_um = std::nan("")}, kNumbers)), HasSubstr("not that of a scan"));
  TiffPage photo;
  photo.number(0x0100, 4, 2);
  std::string file("MM\0*\0\0\0\x08", 8);
  photo.append_to(file);
  EXPECT_THAT(error_of(file), HasSubstr("a TIFF without the size of a scan"));
}

TEST(NanosurfImage, SpreadsItsIntegersOverTheirRange) {
  const LoadedImage image = loaded(nanosurf_file({{}}));
  EXPECT_EQ(image.format, ImageFormat::Nanosurf);
  EXPECT_DOUBLE_EQ(image.image.width_m, 3e-6) << "micrometres in Latin-1";
  EXPECT_DOUBLE_EQ(image.image.height_m, 2e-6);
  EXPECT_EQ(image.image.channels.at(0).name, "Z-Axis");
  const double expected_nm[]{10, 20, -30, 1, 2, 3};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(values(image)[i], 1e-9 * expected_nm[i], 1e-19) << i;
  EXPECT_THAT(image.image.metadata, ElementsAre(Pair("Head type", "EZ2-AFM")));
}

// A range in another unit than the other numbers of its dimension was read as one in theirs.
TEST(NanosurfImage, ReadsTheUnitBehindANumber) {
  const LoadedImage usual = loaded(nanosurf_file({{}}));
  for (const char* same : {"6.5536e-05 m", "65.536 um", "+65.536\xB5m", "65536nm"}) {
    const LoadedImage read = loaded(nanosurf_file({{.range = same}}));
    EXPECT_NEAR(values(read)[2] / values(usual)[2], 1.0, 1e-9) << same;
  }
  EXPECT_THAT(error_of(nanosurf_file({{.range = "3 V"}})),
              HasSubstr("its \"Dim2Range\" is \"3 V\", which is no number of m"));
  EXPECT_THAT(error_of(nanosurf_file({{.range = "3 x"}})), HasSubstr("which is no number of m"));
  EXPECT_THAT(error_of(nanosurf_file({{.save = "SaveBits=16 bit\r\n"}})),
              HasSubstr("its \"SaveBits\" is \"16 bit\", which is no number"));
}

TEST(NanosurfImage, HasIntegersOfEverySizeSignAndOrder) {
  const auto first_of = [](const std::string& save, const std::string& numbers) {
    return values(loaded(nanosurf_file({{.range = "1", .lowest = "0", .save = save, .numbers = numbers}})))[3];
  };
  const std::string zeros(20, '\0');
  EXPECT_DOUBLE_EQ(first_of("SaveBits=32\r\n", little_numbers<std::int32_t>({1 << 30}) + zeros), 0.75);
  EXPECT_DOUBLE_EQ(first_of("SaveBits=8\r\n", std::string("\x80", 1) + zeros.substr(0, 5)), 0.0);
  EXPECT_DOUBLE_EQ(first_of("SaveBits=16\r\nSaveSign=Unsigned\r\n", std::string("\0\x40", 2) + zeros.substr(0, 10)),
                   0.25);
  EXPECT_DOUBLE_EQ(first_of("SaveBits=16\r\nSaveOrder=Motorola\r\n", std::string("\xC0\0", 2) + zeros.substr(0, 10)),
                   0.25);
}

TEST(NanosurfImage, HasItsChannelsInTheOrderOfItsGroups) {
  const LoadedImage image = loaded(nanosurf_file(
      {{.name = "Deflection", .unit = "V"},
       {.group = "Spec forward", .name = "Force", .unit = "N", .rows = 1, .numbers = std::string(6, '\0')},
       {.group = "Scan backward", .numbers = little_numbers<std::int16_t>({7, 7, 7, 8, 9, 7})},
       {.group = "2nd scan forward"}}));
  ASSERT_EQ(image.image.channels.size(), 3U);
  EXPECT_EQ(image.image.channels[0].name, "Deflection");
  EXPECT_EQ(image.image.channels[1].name, "Z-Axis (retrace)");
  EXPECT_EQ(image.image.channels[2].name, "Z-Axis (2nd scan forward)");
  EXPECT_EQ(image.chosen, 2U) << "a height, and no retrace";
  EXPECT_NEAR(image.image.channels[1].values[1], 9e-9, 1e-19);
  ASSERT_EQ(image.unread.size(), 1U);
  EXPECT_THAT(image.unread[0].reason, HasSubstr("spectroscopy"));
}

TEST(NanosurfImage, CountsLinesOfAStoppedScanAsNotMeasured) {
  const LoadedImage image = loaded(
      nanosurf_file({{.last_line = 0, .numbers = little_numbers<std::int16_t>({1, 2, 3, -32768, -32768, -32768})}}));
  EXPECT_THAT(image.remarks, ElementsAre(HasSubstr("stopped after 1 of 2 lines")));
  EXPECT_TRUE(std::isnan(values(image)[0]));
  EXPECT_NEAR(values(image)[3], 1e-9, 1e-19);
}

TEST(NanosurfImage, IsRefusedWhereItIsDamaged) {
  const std::string whole = nanosurf_file({{}});
  EXPECT_THAT(error_of(whole.substr(0, whole.size() - 1)), HasSubstr("cut short"));
  EXPECT_THAT(error_of(whole.substr(0, whole.find("#!"))), HasSubstr("it has no data"));
  EXPECT_THAT(error_of(nanosurf_file({{.save = "SaveBits=24\r\n"}})), HasSubstr("its numbers have 24 bits"));
  EXPECT_THAT(error_of(nanosurf_file({{.range = "wide"}})), HasSubstr("it has no number \"Dim2Range\""));
  EXPECT_THAT(error_of(nanosurf_file({{.save = "SaveMode=ASCII\r\nSaveBits=16\r\n"}})), HasSubstr("\"ASCII\""));
  EXPECT_THAT(error_of("[DataSet]\nVersion=2\n#!"), HasSubstr("it has no number \"GroupCount\""));
}

TEST(VendorImages, SurviveAnyChangeOfTheirBytes) {
  EXPECT_GT(read_after_damage({park_image_file({}, kNumbers), nanosurf_file({{}, {.group = "Scan backward"}})}), 100);
}

}  // namespace vendor_images_test
}  // namespace afm::curves
