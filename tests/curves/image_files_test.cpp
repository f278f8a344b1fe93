// SPDX-License-Identifier: Apache-2.0
// The image files of four programs, put together here byte by byte from their published layouts.
// Invariant: an image file of any of seven programs is read as its format says, or refused in one line
#include "curves/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "damaged_images.h"
#include "support/image_files.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace image_files_test {

using testing::HasSubstr;
using namespace afm::test;

LoadedImage loaded(const std::string& bytes, const std::string& channel = {}) {
  auto image = parse_image(bytes, "scan.x", {.channel = channel});
  EXPECT_TRUE(image) << image.error().message;
  return image ? std::move(*image) : LoadedImage{};
}

std::string error_of(const std::string& bytes, const std::string& channel = {}, bool confined = true) {
  const auto image = parse_image(bytes, "scan.x", {.channel = channel, .confined = confined});
  if (image) return "accepted";
  EXPECT_EQ(image.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_EQ(image.error().message.find('\n'), std::string::npos);
  EXPECT_THAT(image.error().message, HasSubstr("scan.x"));
  return image.error().message;
}

// Read in this process, where a sanitizer sees each byte: for many bytes, a child each would take a minute.
std::string error_here(const std::string& bytes) { return error_of(bytes, {}, false); }

const std::vector<double>& values(const LoadedImage& image) { return image.image.channels.at(image.chosen).values; }

// ---- Gwyddion simple field ----

const std::string kGsfLines =
    "XRes = 3\nYRes = 2\nXReal = 3e-06\nYReal = 2e-06\nXYUnits = m\nZUnits = nm\nTitle = Relief\n";

TEST(GsfImage, IsReadExactly) {
  const LoadedImage image = loaded(gsf_file(kGsfLines + "Comment = two rows\n", {0, 1, 2, 3, 4, 5.5F}));
  EXPECT_EQ(image.format, ImageFormat::Gsf);
  EXPECT_EQ(image.image.columns, 3U);
  EXPECT_EQ(image.image.rows, 2U);
  EXPECT_DOUBLE_EQ(image.image.width_m, 3e-6);
  EXPECT_DOUBLE_EQ(image.image.height_m, 2e-6);
  EXPECT_EQ(image.image.channels.at(0).name, "Relief");
  EXPECT_EQ(image.image.channels.at(0).unit, "m");
  for (std::size_t i = 0; i < 5; ++i) EXPECT_DOUBLE_EQ(values(image)[i], 1e-9 * static_cast<double>(i));
  EXPECT_DOUBLE_EQ(values(image)[5], 5.5e-9);
  EXPECT_THAT(image.image.metadata, testing::Contains(testing::Pair("Comment", "two rows")));
}

TEST(GsfImage, HasOneToFourNulsBeforeItsData) {
  for (const char* title : {"a", "ab", "abc", "abcd"}) {
    const std::string bytes = gsf_file(std::string("XRes = 2\nYRes = 2\nTitle = ") + title + "\n", {1, 2, 3, 4});
    EXPECT_EQ(values(loaded(bytes)), (std::vector<double>{1, 2, 3, 4})) << title;
  }
}

TEST(GsfImage, WithoutXRealIsOneWideAndSidesCountByTheirAbsoluteValue) {
  const LoadedImage image = loaded(gsf_file("XRes = 2\nYRes = 2\nYReal = -0.5\n", {1, 2, 3, 4}));
  EXPECT_EQ(image.image.width_m, 1.0);
  EXPECT_EQ(image.image.height_m, 0.5);
}

TEST(GsfImage, SaysThatSidesWithoutAUnitAreTakenAsMetres) {
  for (const char* unit : {"", "XYUnits = \n"}) {
    const std::string bytes = gsf_file(std::string("XRes=2\nYRes=2\nXReal=1\nYReal=1\n") + unit, {1, 2, 3, 4});
    EXPECT_THAT(loaded(bytes).remarks, testing::ElementsAre(HasSubstr("taken as metres"))) << unit;
  }
  EXPECT_THAT(loaded(gsf_file(kGsfLines, {0, 1, 2, 3, 4, 5})).remarks, testing::IsEmpty());
}

TEST(GsfImage, MasksNaNAndWhatIsInfinite) {
  const LoadedImage image = loaded(gsf_file("XRes = 2\nYRes = 2\n", {1, std::nanf(""), -HUGE_VALF, 4}));
  EXPECT_THAT(values(image), testing::ElementsAre(1, testing::IsNan(), testing::IsNan(), 4));
}

TEST(GsfImage, IsRefusedWhereItIsDamaged) {
  const std::string whole = gsf_file(kGsfLines, {0, 1, 2, 3, 4, 5});
  EXPECT_THAT(error_of(whole.substr(0, whole.size() - 1)), HasSubstr("cut short"));
  EXPECT_THAT(error_of(whole + "x"), HasSubstr("longer than"));
  EXPECT_THAT(error_of(gsf_file("XRes = 2\n", {1})), HasSubstr("no XRes or no YRes"));
  EXPECT_THAT(error_of(gsf_file("XRes = 1e9\nYRes = 1e9\n", {1})), HasSubstr("2 to 8192"));
  EXPECT_THAT(error_of(gsf_file("XRes = 2.5\nYRes = 2\n", {1})), HasSubstr("2 to 8192"));
  EXPECT_THAT(error_of(gsf_file("XRes = 2\nYRes = 2\nXReal = 0\n", {1, 2, 3, 4})), HasSubstr("not that of a scan"));
  EXPECT_THAT(error_of(gsf_file("XRes = 2\nYRes = two\n", {1})), HasSubstr("not a finite number"));
}

// ---- Gwyddion ----

std::string two_fields() {
  return gwy_field("/0/data", 2, 2, 1e-6, 1e-6, "V", {1, 2, 3, 4}) + gwy_string("/0/data/title", "Deflection") +
         gwy_field("/3/data", 2, 2, 1e-6, 1e-6, "m", {1e-9, std::nan(""), 3e-9, 4e-9}) +
         gwy_string("/3/data/title", "Height") + gwy_field("/4/data", 3, 2, 1e-6, 1e-6, "deg", {1, 2, 3, 4, 5, 6}) +
         gwy_object("/0/meta", "GwyContainer", gwy_string("Rate", "1 Hz")) +
         gwy_object("/3/mask", "GwyDataField", gwy_int("xres", 2));
}

TEST(GwyImage, MasksWhatIsBeyondAnyInstrument) {
  const auto heights = values(loaded(gwy_file(gwy_field("/0/data", 2, 2, 1, 1, "m", {1e-9, 1e300, -1.1e100, -1e99}))));
  EXPECT_THAT(heights, testing::ElementsAre(1e-9, testing::IsNan(), testing::IsNan(), -1e99));
}

TEST(GwyImage, IsReadExactly) {
  const LoadedImage image = loaded(gwy_file(two_fields()));
  EXPECT_EQ(image.format, ImageFormat::Gwy);
  ASSERT_EQ(image.image.channels.size(), 2U) << "those on the grid of the height";
  EXPECT_EQ(image.chosen, 1U);
  EXPECT_EQ(image.image.channels[0].name, "Deflection");
  EXPECT_EQ(image.image.channels[0].unit, "V");
  EXPECT_EQ(image.image.channels[0].values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(values(image)[0], 1e-9);
  EXPECT_TRUE(std::isnan(values(image)[1]));
  EXPECT_EQ(values(image)[3], 4e-9);
  EXPECT_EQ(image.image.x_offset_m, 1e-7);
  EXPECT_EQ(image.image.y_offset_m, -2e-7);
  EXPECT_THAT(image.left_out, testing::ElementsAre("Channel 4"));
  EXPECT_THAT(image.image.metadata, testing::Contains(testing::Pair("Rate", "1 Hz")));
}

TEST(GwyImage, SaysThatSidesWithoutAUnitAreTakenAsMetres) {
  const std::string fields = two_fields();
  EXPECT_THAT(loaded(gwy_file(fields)).remarks, testing::IsEmpty());
  const std::string field = gwy_int("xres", 2) + gwy_int("yres", 2) + gwy_double("xreal", 0.5) +
                            gwy_double("yreal", 0.5) + gwy_doubles("data", {1, 2, 3, 4});
  EXPECT_THAT(loaded(gwy_file(gwy_object("/0/data", "GwyDataField", field))).remarks,
              testing::ElementsAre(HasSubstr("taken as metres")));
}

TEST(GwyImage, GivesTheChannelThatIsAskedFor) {
  const std::string bytes = gwy_file(two_fields());
  EXPECT_EQ(loaded(bytes, "deflection").chosen, 0U);
  const LoadedImage third = loaded(bytes, "Channel 4");
  EXPECT_EQ(third.image.columns, 3U);
  EXPECT_EQ(values(third)[5], 6.0);
  EXPECT_THAT(error_of(bytes, "Phase"), HasSubstr("it has Deflection, Height, Channel 4"));
}

TEST(GwyImage, IsRefusedWhereItIsDamaged) {
  const std::string whole = gwy_file(two_fields());
  for (std::size_t size = 0; size < whole.size(); size += 7) EXPECT_NE(error_here(whole.substr(0, size)), "accepted");
  EXPECT_THAT(error_of(gwy_file("")), HasSubstr("no image"));
  EXPECT_THAT(error_of(gwy_file(gwy_field("/0/data", 2, 3, 1, 1, "m", {1, 2}))), HasSubstr("do not fill"));
  EXPECT_THAT(error_of(gwy_file(std::string("/0/data\0?", 9))), HasSubstr("unknown type"));
  // a count that promises more than the file has
  EXPECT_THAT(error_of(gwy_file(std::string("/x\0D\xff\xff\xff\xff", 8))), HasSubstr("cut short"));
}

TEST(GwyImage, GoesNoDeeperThanItMust) {
  std::string nested = gwy_int("x", 1);
  for (int i = 0; i < 20'000; ++i) nested = gwy_object("o", "GwyContainer", nested);
  EXPECT_THAT(error_of(gwy_file(nested)), HasSubstr("no image"));
}

// ---- Nanoscope ----

NanoscopeChannel nanoscope_height(int bytes_per_pixel, int bytes_of_integer) {
  return {.bytes_per_pixel = bytes_per_pixel,
          .bytes_of_integer = bytes_of_integer,
          .columns = 3,
          .rows = 2,
          .integers = {-4, -5, -6, 20000, 0, 1}};
}

// research case A34
TEST(NanoscopeImage, TakesFourByteIntegersAndTheDivisorOfTwo) {
  const LoadedImage image = loaded(nanoscope_file("0x09300000", {nanoscope_height(2, 4)}));
  EXPECT_EQ(image.format, ImageFormat::Nanoscope);
  EXPECT_NEAR(values(image)[0], 1.678466797e-06, 1e-9 * 1.678466797e-06);
  EXPECT_NEAR(values(image)[0], 20000.0 * 440.0 / 65536.0 * 12.5e-9, 1e-12 * values(image)[0]);
  EXPECT_EQ(image.image.channels[0].unit, "m");
}

TEST(NanoscopeImage, TakesBytesPerPixelAtItsWordBeforeThatVersion) {
  const double lsb = 440.0 / 65536.0 * 12.5e-9;
  const auto two = values(loaded(nanoscope_file("0x08150300", {nanoscope_height(2, 2)})));
  const double expected[] = {20000, 0, 1, -4, -5, -6};  // bottom row, first in the file
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(two[i], expected[i] * lsb, 1e-12 * std::abs(two[i]));
  const auto four = values(loaded(nanoscope_file("0x09100000", {nanoscope_height(4, 4)})));
  EXPECT_NEAR(four[0], two[0] / 65536.0, 1e-12 * four[0]);
  EXPECT_NE(error_of(nanoscope_file("0x09300000", {nanoscope_height(2, 2)})), "accepted") << "two bytes are too few";
}

TEST(NanoscopeImage, HasTheSizeNamesAndUnitsOfItsBlocks) {
  NanoscopeChannel deflection = nanoscope_height(2, 2), phase = nanoscope_height(2, 2), back = nanoscope_height(2, 2);
  deflection.name = "Deflection Error";
  deflection.z_scale = "V [Sens. DeflSens] (0.000375 V/LSB) 24.576 V";
  phase.name = "Phase";
  phase.z_scale = "V (0.0055 deg/LSB) 360 deg";
  back.direction = "Retrace";
  back.scan_size = "1000 500 ~m";
  NanoscopeChannel height = nanoscope_height(2, 2);
  height.name = "Height Sensor";
  const std::string bytes = nanoscope_file("0x08150300", {deflection, phase, back, height});
  const LoadedImage image = loaded(bytes);
  EXPECT_DOUBLE_EQ(image.image.width_m, 1e-6);
  EXPECT_DOUBLE_EQ(image.image.height_m, 0.5e-6);
  EXPECT_EQ(image.image.channels.at(image.chosen).name, "Height Sensor");
  EXPECT_EQ(image.image.channels.at(0).unit, "m");
  EXPECT_NEAR(image.image.channels.at(0).values[0], 20000 * 24.576 / 65536 * 40e-9, 1e-18);
  EXPECT_EQ(image.image.channels.at(1).unit, "deg");
  EXPECT_NEAR(image.image.channels.at(1).values[0], 20000 * 360.0 / 65536, 1e-9);
  EXPECT_THAT(image.left_out, testing::ElementsAre("Height (retrace)")) << "of another size";
  EXPECT_DOUBLE_EQ(loaded(bytes, "height (retrace)").image.width_m, 1e-3);
}

TEST(NanoscopeImage, IsRefusedWhereItIsDamaged) {
  const std::string whole = nanoscope_file("0x08150300", {nanoscope_height(2, 2)});
  EXPECT_THAT(error_of(whole.substr(0, whole.size() - 1)), HasSubstr("cut short"));
  EXPECT_THAT(error_of(nanoscope_file("0x08150300", {})), HasSubstr("no image"));
  NanoscopeChannel odd = nanoscope_height(3, 3);
  EXPECT_THAT(error_of(nanoscope_file("0x08150300", {odd})), HasSubstr("3 bytes a pixel"));
  odd = nanoscope_height(2, 2);
  odd.columns = 2'000'000'000;
  EXPECT_THAT(error_of(nanoscope_file("0x08150300", {odd})), HasSubstr("2 to 8192"));
  odd = nanoscope_height(2, 2);
  odd.z_scale = "C [Sens. Zsens] 440 V";
  EXPECT_THAT(error_of(nanoscope_file("0x08150300", {odd})), HasSubstr("Z scale"));
  odd = nanoscope_height(2, 2);
  odd.scan_size = "10 V";
  EXPECT_THAT(error_of(nanoscope_file("0x08150300", {odd})), HasSubstr("scan size"));
}

// ---- Igor ----

std::vector<float> layers() { return {1e-9F, 2e-9F, 3e-9F, 4e-9F, 5e-9F, 6e-9F, 10, 20, 30, 40, 50, NAN}; }

TEST(IgorImage, IsReadExactly) {
  const LoadedImage image =
      loaded(igor_image_file(3, 2, {"PhaseTrace", "HeightTrace"}, 5e-9, "ScanSize: 1.5e-08\rScanRate: 1\r", layers()));
  EXPECT_EQ(image.format, ImageFormat::Igor);
  EXPECT_EQ(image.image.columns, 3U);
  EXPECT_EQ(image.image.rows, 2U);
  EXPECT_DOUBLE_EQ(image.image.width_m, 15e-9);
  EXPECT_DOUBLE_EQ(image.image.height_m, 10e-9);
  EXPECT_EQ(image.chosen, 1U);
  EXPECT_EQ(image.image.channels[0].unit, "deg");
  EXPECT_EQ(image.image.channels[1].unit, "m");
  // the second line of the wave is the top row
  EXPECT_EQ(image.image.channels[0].values[0], static_cast<double>(4e-9F));
  EXPECT_EQ(image.image.channels[0].values[3], static_cast<double>(1e-9F));
  EXPECT_EQ(values(image)[0], 40.0);
  EXPECT_TRUE(std::isnan(values(image)[2]));
  EXPECT_EQ(values(image)[5], 30.0);
  EXPECT_THAT(image.image.metadata, testing::Contains(testing::Pair("ScanRate", "1")));
}

// File written by Igor on a Macintosh with another processor.
TEST(IgorImage, IsTheSameInEitherOrderOfItsBytes) {
  const auto file = [](bool big) {
    return igor_image_file(3, 2, {"PhaseTrace", "HeightTrace"}, 5e-9, "ScanRate: 1\r", layers(), big);
  };
  const LoadedImage little = loaded(file(false)), big = loaded(file(true));
  EXPECT_NE(file(true), file(false));
  EXPECT_EQ(big.format, ImageFormat::Igor);
  EXPECT_EQ(big.image.width_m, little.image.width_m);
  EXPECT_EQ(big.image.metadata, little.image.metadata);
  ASSERT_EQ(big.image.channels.size(), 2U);
  EXPECT_EQ(big.image.channels[0].values, little.image.channels[0].values);
  EXPECT_EQ(big.image.channels[1].name, "HeightTrace");
  EXPECT_EQ(values(big)[0], 40.0);
}

TEST(IgorImage, IsAlsoAMatrixWithTheNameOfItsWave) {
  const LoadedImage image = loaded(igor_image_file(3, 2, {}, 5e-9, "", {1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(image.image.channels.size(), 1U);
  EXPECT_EQ(image.image.channels[0].name, "relief");
  EXPECT_EQ(image.image.channels[0].unit, "") << "nobody says what it is";
  EXPECT_DOUBLE_EQ(image.image.width_m, 15e-9);
  EXPECT_EQ(values(image), (std::vector<double>{4, 5, 6, 1, 2, 3}));
}

// Version 2 has one dimension.
TEST(IgorImage, NamesTheVersionThatItCannotBe) {
  std::string old(200, '\0');
  old[0] = 2;
  old[14] = static_cast<char>(0xfe);
  old[15] = static_cast<char>(0xff);
  EXPECT_THAT(error_of(old), HasSubstr("it is an Igor wave of version 2, which holds one row of numbers"));
}

TEST(IgorImage, IsRefusedWhereItIsDamaged) {
  const std::string whole = igor_image_file(3, 2, {"HeightTrace", "PhaseTrace"}, 5e-9, "a: 1\r", layers());
  EXPECT_THAT(error_of(whole.substr(0, 400)), HasSubstr("cut short"));
  std::string altered = whole;
  altered[100] = 'x';
  EXPECT_THAT(error_of(altered), HasSubstr("checksum"));
  EXPECT_THAT(error_of(igor_image_file(3, 2, {"HeightTrace"}, 5e-9, "", layers())), HasSubstr("does not fit"));
  EXPECT_THAT(error_of(igor_image_file(3, 2, {"HeightTrace", "B"}, std::nan(""), "", layers())),
              HasSubstr("not that of a scan"));
}

// ---- JPK ----

const std::vector<JpkSlot> kSlots{{"volts", "V", 1e-4, -1}, {"nominal", "m", 2e-9, 5e-8}};
const std::vector<std::int64_t> kRaw{1000, 2000, 3000, -1, -2, -3};

// research case A35
TEST(JpkImage, TakesItsDefaultSlot) {
  const LoadedImage image = loaded(
      jpk_image_file(3e-6, 2e-6, {jpk_channel("height", false, 3, 2, kSlots, "nominal", 16, {1, 2, 3, 1000, 0, 0})}));
  EXPECT_EQ(image.format, ImageFormat::Jpk);
  EXPECT_NEAR(values(image)[0], 2.05e-06, 1e-12 * 2.05e-06);
  EXPECT_EQ(image.image.channels[0].unit, "m");
  const LoadedImage volts =
      loaded(jpk_image_file(3e-6, 2e-6, {jpk_channel("height", false, 3, 2, kSlots, "volts", 16, kRaw)}));
  EXPECT_EQ(volts.image.channels[0].unit, "V");
  EXPECT_NEAR(values(volts)[3], 1000 * 1e-4 - 1, 1e-15) << "bottom up";
}

TEST(JpkImage, HasTheGridOfItsFirstPageAndTheDirectionsOfItsChannels) {
  const LoadedImage image =
      loaded(jpk_image_file(3e-6, 2e-6,
                            {jpk_channel("error", false, 3, 2, kSlots, "volts", 32, kRaw),
                             jpk_channel("Height", true, 3, 2, kSlots, "nominal", 32, kRaw),
                             jpk_channel("Height", false, 3, 2, kSlots, "nominal", 32, {1, 2, 3, 70000, 5, 6})}));
  EXPECT_DOUBLE_EQ(image.image.width_m, 3e-6);
  EXPECT_DOUBLE_EQ(image.image.height_m, 2e-6);
  EXPECT_EQ(image.image.x_offset_m, 1e-6);
  EXPECT_EQ(image.image.channels.at(1).name, "Height (retrace)");
  EXPECT_EQ(image.image.channels.at(image.chosen).name, "Height");
  EXPECT_NEAR(values(image)[0], 70000 * 2e-9 + 5e-8, 1e-18);
  EXPECT_THAT(image.image.metadata, testing::Contains(testing::Pair("Name", "a test")));
}

TEST(JpkImage, IsTopDownWhereItsGridIsReflected) {
  TiffPage channel = jpk_channel("height", false, 3, 2, kSlots, "nominal", 16, kRaw);
  channel.number(0x8045, 8, 1);
  EXPECT_NEAR(values(loaded(jpk_image_file(3e-6, 2e-6, {channel})))[0], 2.05e-06, 1e-18);
}

TEST(JpkImage, IsRefusedWhereItIsDamaged) {
  const auto channel = jpk_channel("height", false, 3, 2, kSlots, "nominal", 16, kRaw);
  const std::string whole = jpk_image_file(3e-6, 2e-6, {channel});
  for (std::size_t size = 8; size < whole.size(); size += 5) EXPECT_NE(error_here(whole.substr(0, size)), "accepted");
  EXPECT_THAT(error_of(jpk_image_file(3e-6, 2e-6, {jpk_channel("h", false, 3, 2, kSlots, "absent", 16, kRaw)})),
              HasSubstr("no linear calibration \"absent\""));
  EXPECT_THAT(error_of(jpk_image_file(3e-6, 2e-6, {jpk_channel("h", false, 4, 2, kSlots, "volts", 16, kRaw)})),
              HasSubstr("do not fill it"));
  EXPECT_THAT(error_of(jpk_image_file(std::nan(""), 2e-6, {channel})), HasSubstr("not that of a scan"));
  TiffPage packed = channel;
  packed.number(0x0103, 3, 5);
  EXPECT_THAT(error_of(jpk_image_file(3e-6, 2e-6, {packed})), HasSubstr("compressed"));
  // a directory that is its own next one
  std::string circle("MM\0*\0\0\0\x08\0\x02", 10);
  for (const int tag : {0x8042, 0x8043}) {
    append_big(circle, static_cast<std::uint16_t>(tag));
    append_big(circle, std::uint16_t{11});
    append_big(circle, std::uint32_t{1});
    append_big(circle, 1e-6F);
  }
  append_big(circle, std::uint32_t{8});
  EXPECT_THAT(error_of(circle), HasSubstr("no end"));
}

// ---- all ----

TEST(ImageFiles, AreKnownByTheirFirstBytesAlone) {
  const support::ScratchFolder folder;
  const auto is_image = [&](const std::string& bytes) { return is_image_file(folder.write("scan.x", bytes)); };
  for (const char* bytes : {"GWYP", "\\*File list\r\n"}) EXPECT_TRUE(is_image(bytes)) << bytes;
  for (const char* bytes : {"", "glTF", "\\*Force file list\r\n"}) EXPECT_FALSE(is_image(bytes)) << bytes;
  EXPECT_THAT(error_of("no image at all"), HasSubstr("no image of a known kind"));
}

TEST(ImageFiles, AreReadInTheChildAsTheyAreHere) {
  const std::string bytes = gwy_file(two_fields());
  const auto here = parse_image(bytes, "scan.x", {.channel = "Deflection", .confined = false});
  const auto there = parse_image(bytes, "scan.x", {.channel = "Deflection"});
  ASSERT_TRUE(here && there);
  EXPECT_EQ(here->image.channels[0].values, there->image.channels[0].values);
  EXPECT_EQ(here->image.metadata, there->image.metadata);
  EXPECT_EQ(here->left_out, there->left_out);
  EXPECT_EQ(here->image.y_offset_m, there->image.y_offset_m);
}

TEST(ImageFiles, SurviveAnyChangeOfTheirBytes) {
  const std::vector<std::string> files{
      gsf_file(kGsfLines, {0, 1, 2, 3, 4, 5}),
      gwy_file(two_fields()),
      nanoscope_file("0x09300000", {nanoscope_height(2, 4)}),
      igor_image_file(3, 2, {"HeightTrace", "PhaseTrace"}, 5e-9, "a: 1\r", layers()),
      igor_image_file(3, 2, {}, 5e-9, "", {1, 2, 3, 4, 5, 6}, true),
      jpk_image_file(3e-6, 2e-6, {jpk_channel("height", false, 3, 2, kSlots, "nominal", 16, kRaw)})};
  EXPECT_GT(read_after_damage(files), 100);
}

}  // namespace image_files_test
}  // namespace afm::curves
