// SPDX-License-Identifier: Apache-2.0
// Images as laboratories bring them (tests/data/afm, synthetic, made from published layouts), and others of their kinds
// that are put together here.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "curves/image_file.h"
#include "curves/measured_topography.h"
#include "support/image_files.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace lab_images_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kFourDigits = 1e-4;  // relative tolerance

std::string path_of(const std::string& name) { return support::source("tests/data/afm/" + name); }

MeasuredTopography image(const std::string& name, const std::string& channel = {}) {
  auto loaded = load_topography(path_of(name), {.image = {.channel = channel}});
  EXPECT_TRUE(loaded.has_value()) << loaded.error().message;
  return loaded ? std::move(*loaded) : MeasuredTopography{};
}

void expect_near(double value, double expected) { EXPECT_NEAR(value / expected, 1.0, kFourDigits); }

// Lengths in nm.
struct HeightImage {
  const char* name;
  double width, height, mean, sq, lowest, highest, sq_levelled;
  std::vector<std::string> channels, left_out;
};

const HeightImage kHeightImages[]{
    {"qnm-log.spm", 640, 480, -0.0054279, 3.7188, -6.7939, 6.7263, 2.5054, {"Height Sensor", "LogDMTModulus"}, {}},
    {"ec-file-list.spm", 600, 450, 0.020002, 2.9553, -5.5278, 5.1366, 1.9966, {"Height"}, {}},
    {"one-empty-channel.spm", 600, 450, 0.020002, 2.9553, -5.5278, 5.1366, 1.9966, {"Height"}, {"Input2"}},
    {"aspect-captured.spm", 600, 450, 0.020002, 2.9553, -5.5278, 5.1366, 1.9966, {"Height"}, {}},
    {"phase-without-scaling.jpk", 1000, 750, -0.036464, 4.4113, -8.214, 7.709, 2.988, {"height"}, {"phase"}},
    {"profile-beside.gwy", 500, 375, 0.014677, 3.6924, -6.4188, 6.7859, 2.5187, {"Height"}, {"Row"}},
    {"pixels-beside.gwy", 500, 375, 0.014677, 3.6924, -6.4188, 6.7859, 2.5187, {"Height"}, {"Correlation"}},
    {"layers-without-labels.ibw", 500, 375, 0.014677, 3.6924, -6.4188, 6.7859, 2.5187, {"Layer 0", "Layer 1"}, {}}};

class LabImages : public testing::TestWithParam<HeightImage> {};

TEST_P(LabImages, HaveTheirHeightsWhateverLiesBeside) {
  const HeightImage& expected = GetParam();
  const MeasuredTopography read = image(expected.name);
  const physics::ScanImage& scan = read.file.image;
  EXPECT_EQ(scan.columns, 16U);
  EXPECT_EQ(scan.rows, 12U);
  expect_near(scan.width_m * 1e9, expected.width);
  expect_near(scan.height_m * 1e9, expected.height);
  expect_near(read.raw.mean * 1e9, expected.mean);
  expect_near(read.raw.sq * 1e9, expected.sq);
  expect_near(read.raw.lowest * 1e9, expected.lowest);
  expect_near(read.raw.highest * 1e9, expected.highest);
  expect_near(read.levelled.sq * 1e9, expected.sq_levelled);
  std::vector<std::string> channels, left_out;
  for (const auto& each : scan.channels) channels.push_back(each.name);
  for (const UnreadChannel& each : read.file.unread) {
    left_out.push_back(each.name);
    EXPECT_THAT(topography_text(read), HasSubstr(each.name + ": " + each.reason));
  }
  EXPECT_EQ(channels, expected.channels);
  EXPECT_EQ(left_out, expected.left_out);
  EXPECT_TRUE(felt_topography(read).has_value());
}

INSTANTIATE_TEST_SUITE_P(LabFiles, LabImages, testing::ValuesIn(kHeightImages), [](const auto& each) {
  std::string name = each.param.name;
  std::replace_if(name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
  return name;
});

TEST(LabImageFiles, GiveTheReasonForEachChannelThatIsLeftOut) {
  EXPECT_THAT(image("one-empty-channel.spm").file.unread.at(0).reason, HasSubstr("points on a side: 0; 2 to 8192"));
  EXPECT_THAT(image("phase-without-scaling.jpk").file.unread.at(0).reason, HasSubstr("no linear calibration"));
  EXPECT_THAT(image("profile-beside.gwy").file.unread.at(0).reason, HasSubstr("points on a side: 1; 2 to 8192"));
  EXPECT_THAT(image("pixels-beside.gwy").file.unread.at(0).reason, HasSubstr("\"px\", not in a length"));
  EXPECT_EQ(image("qnm-log.spm").file.image.channels.at(1).unit, "log(Pa)");
  const auto json = topography_json(image("one-empty-channel.spm"));
  EXPECT_EQ(json.at("left_out").at(0).at("name"), "Input2");
}

TEST(LabImageFiles, RefuseAChannelThatIsAskedForAndCannotBeRead) {
  const auto asked = load_image(path_of("one-empty-channel.spm"), {.channel = "input2"});
  ASSERT_FALSE(asked.has_value());
  EXPECT_THAT(asked.error().message, HasSubstr("its channel Input2 cannot be read: points on a side: 0"));
}

TEST(LabImageFiles, SayThatAScanWasStopped) {
  EXPECT_THAT(image("aspect-captured.spm").file.remarks, ElementsAre(HasSubstr("12 of 16 lines were captured")));
  const MeasuredTopography stopped = image("captured-lines.spm");
  EXPECT_THAT(stopped.file.remarks, testing::Contains(HasSubstr("5 of 12 lines were captured")));
  EXPECT_EQ(stopped.raw.measured, 5U * 16U);
  EXPECT_NEAR(stopped.raw.mean, -0.11902e-9, 1e-12);
  EXPECT_THAT(topography_text(stopped), HasSubstr("5 of 12 lines"));
}

// Bytes of an image, as a file; the name is the format's.
LoadedImage parsed(const std::string& bytes) {
  auto read = parse_image(bytes, "image.x");
  EXPECT_TRUE(read.has_value()) << read.error().message;
  return read ? std::move(*read) : LoadedImage{};
}

TEST(LabImageFiles, LeaveOutWhatIsInNoLength) {
  using namespace afm::test;
  for (const char* unit : {"deg", "rad", "px", "1/m", "V", "s"}) {
    const std::string angles = gwy_object(
        "/1/data", "GwyDataField",
        gwy_int("xres", 2) + gwy_int("yres", 2) + gwy_double("xreal", 0.5) + gwy_double("yreal", 0.5) +
            gwy_object("si_unit_xy", "GwySIUnit", gwy_string("unitstr", unit)) + gwy_doubles("data", {1, 2, 3, 4}));
    const LoadedImage read =
        parsed(gwy_file(gwy_field("/0/data", 2, 2, 1e-6, 1e-6, "m", {1e-9, 2e-9, 3e-9, 4e-9}) + angles));
    ASSERT_EQ(read.unread.size(), 1U) << unit;
    EXPECT_THAT(read.unread[0].reason, HasSubstr(fmt::format("\"{}\", not in a length", unit)));
    EXPECT_EQ(read.image.channels.size(), 1U);
  }
  const auto pixels = parse_image(gsf_file("XRes = 2\nYRes = 2\nXReal=0.5\nXYUnits = px\n", {1, 2, 3, 4}), "a.gsf");
  ASSERT_FALSE(pixels.has_value());
  EXPECT_THAT(pixels.error().message, HasSubstr("\"px\", not in a length"));
}

test::NanoscopeChannel nanoscope(const std::string& name, int columns, int rows) {
  test::NanoscopeChannel channel{
      .bytes_per_pixel = 2, .bytes_of_integer = 2, .columns = columns, .rows = rows, .integers = {}};
  channel.name = name;
  for (int i = 0; i < columns * rows; ++i) channel.integers.push_back(i);
  return channel;
}

TEST(LabImageFiles, LeaveOutOneNanoscopeChannel) {
  const test::NanoscopeChannel height = nanoscope("Height", 4, 2);
  for (const auto& [scale, reason] : {std::pair("C [Sens. Zsens] 440 V", "no \"@2:Z scale\""),
                                      std::pair("V [Sens. Zsens] (0.0067 V/LSB) none", "has no number")}) {
    test::NanoscopeChannel odd = nanoscope("Odd", 4, 2);
    odd.z_scale = scale;
    for (const auto& channels : {std::vector{height, odd}, std::vector{odd, height}}) {
      const LoadedImage read = parsed(test::nanoscope_file("0x08150300", channels));
      ASSERT_EQ(read.unread.size(), 1U);
      EXPECT_EQ(read.unread[0].name, "Odd");
      EXPECT_THAT(read.unread[0].reason, HasSubstr(reason));
      EXPECT_EQ(read.image.channels.at(read.chosen).name, "Height");
    }
  }
  // a file that is cut short was not copied whole
  const std::string whole = test::nanoscope_file("0x08150300", {height, height});
  const auto cut = parse_image(whole.substr(0, whole.size() - 3), "a.spm");
  ASSERT_FALSE(cut.has_value());
  EXPECT_THAT(cut.error().message, HasSubstr("it is cut short"));
}

TEST(LabImageFiles, SayWhyThereIsNoHeightToFeel) {
  test::NanoscopeChannel phase = nanoscope("Phase", 4, 2), height = nanoscope("Height", 4, 2);
  phase.z_scale = "V (0.0055 deg/LSB) 360 deg";
  height.z_scale = "C [Sens. Zsens] 440 V";
  const support::ScratchFolder folder;
  const auto read = load_topography(folder.write("a.spm", test::nanoscope_file("0x08150300", {height, phase})), {});
  ASSERT_TRUE(read.has_value()) << read.error().message;
  const auto felt = felt_topography(*read);
  ASSERT_FALSE(felt.has_value());
  EXPECT_THAT(felt.error().message, HasSubstr("its channel Height cannot be read: it has no \"@2:Z scale\""));
}

TEST(LabImageFiles, TakeSensitivitiesInAnyUnit) {
  test::NanoscopeChannel milli = nanoscope("Height", 4, 2);
  milli.z_scale = "V [Sens. Zsens] (0.0067 mV/LSB) 440 mV";
  const LoadedImage read = parsed(test::nanoscope_file("0x08150300", {milli}));
  EXPECT_NEAR(read.image.channels[0].values[0] / (4 * 0.44 / 65536 * 12.5e-9), 1.0, 1e-9);
}

TEST(LabImageFiles, NameASensitivityThatTheHeaderLacks) {
  test::NanoscopeChannel height = nanoscope("Height", 4, 2);
  height.z_scale = "V [Sens. Zother] (0.0067 V/LSB) 440 V";
  const LoadedImage read = parsed(test::nanoscope_file("0x08150300", {height}));
  EXPECT_THAT(read.remarks,
              ElementsAre(HasSubstr("its channel Height names the sensitivity \"Sens. Zother\", which its "
                                    "header lacks: its values are in V")));
}

// If nothing contradicts it, the header is believed, and the user informed.
TEST(LabImageFiles, BelieveASizeOfPixelsThatAreNotSquareAndSayIt) {
  test::NanoscopeChannel fast = nanoscope("Height", 4, 2);
  fast.scan_size = "900 900 nm";
  const LoadedImage read = parsed(test::nanoscope_file("0x08150300", {fast}));
  EXPECT_DOUBLE_EQ(read.image.height_m, 900e-9);
  EXPECT_THAT(read.remarks, ElementsAre(HasSubstr("its pixels are not square")));
  std::string narrow = test::nanoscope_file("0x08150300", {fast});
  const std::string size = "\\Scan Size: 900 nm\r\n";
  narrow.replace(narrow.find(size), size.size(), "\\Aspect Ratio:2:1 \r\n");
  EXPECT_DOUBLE_EQ(parsed(narrow).image.height_m, 450e-9);
  EXPECT_THAT(parsed(narrow).remarks, ElementsAre(HasSubstr("its aspect ratio is 2")));
  fast.scan_size = "900 450 nm";
  EXPECT_THAT(parsed(test::nanoscope_file("0x08150300", {fast})).remarks, IsEmpty());
}

TEST(LabImageFiles, TakeTheHeightOfAStoppedScanFromItsLines) {
  const auto area = [](const char* scan_size, int columns, int rows, const char* list) {
    test::NanoscopeChannel channel = nanoscope("Height", columns, rows);
    channel.scan_size = scan_size;
    std::string bytes = test::nanoscope_file("0x08150300", {channel});
    const std::string size = "\\Scan Size: 900 nm\r\n";
    std::string lines = list;
    lines.resize(size.size() - 2, ' ');
    bytes.replace(bytes.find(size), size.size(), lines + "\r\n");
    const LoadedImage read = parsed(bytes);
    EXPECT_EQ(read.remarks.empty(), scan_size == std::string("800 400 nm")) << scan_size;
    return std::pair(read.image.width_m * 1e9, read.image.height_m * 1e9);
  };
  using testing::DoubleNear;
  EXPECT_THAT(area("800 800 nm", 8, 3, "\\Lines: 8"), testing::Pair(DoubleNear(800, 1e-6), DoubleNear(300, 1e-6)));
  EXPECT_THAT(area("800 800 nm", 4, 4, "\\Lines: 8"), testing::Pair(DoubleNear(800, 1e-6), DoubleNear(400, 1e-6)));
  EXPECT_THAT(area("800 600 nm", 8, 3, "\\Lines: 6"), testing::Pair(DoubleNear(800, 1e-6), DoubleNear(300, 1e-6)));
  // if the size is that of the image, the number of lines does not count
  EXPECT_THAT(area("800 400 nm", 8, 4, "\\Lines: 8"), testing::Pair(DoubleNear(800, 1e-6), DoubleNear(400, 1e-6)));
}

TEST(LabImageFiles, TakeAnIgorWaveOfOneLayer) {
  std::string bytes = test::igor_image_file(3, 2, {}, 5e-9, "", {1, 2, 3, 4, 5, 6});
  // one more layer in the header, with an unchanged sum of its words
  const auto word = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  bytes[140] = 1;
  const int sum = word(2) + 256 * word(3) - 1;
  bytes[2] = static_cast<char>(sum & 0xff);
  bytes[3] = static_cast<char>((sum >> 8) & 0xff);
  const support::ScratchFolder folder;
  EXPECT_TRUE(is_image_file(folder.write("a.ibw", bytes)));
  const LoadedImage read = parsed(bytes);
  ASSERT_EQ(read.image.channels.size(), 1U);
  EXPECT_EQ(read.image.channels[0].name, "relief");
  EXPECT_EQ(read.image.channels[0].values, (std::vector<double>{4, 5, 6, 1, 2, 3}));
}

TEST(LabImageFiles, SayThatTheirSizeOrHeightsAreImpossible) {
  const auto remarks = [](const std::string& lines, const std::vector<float>& values) {
    return parsed(test::gsf_file("XRes = 2\nYRes = 2\nXYUnits = um\nZUnits = m\n" + lines, values)).remarks;
  };
  const std::vector<float> low{1e-9F, 2e-9F, 3e-9F, 4e-9F};
  EXPECT_THAT(remarks("XReal = 1\nYReal = 2\n", low), IsEmpty());
  EXPECT_THAT(remarks("", low), ElementsAre(HasSubstr("its size (XReal, YReal), which is taken as 1e-06 m")));
  EXPECT_THAT(remarks("XReal = 1\n", low), ElementsAre(HasSubstr("its height (YReal)")));
  EXPECT_THAT(remarks("YReal = 1\n", low), ElementsAre(HasSubstr("its width (XReal)")));
  const std::vector<float> swapped{1e-9F, -2e30F, 3e-9F, 4e-9F};
  EXPECT_THAT(remarks("XReal = 1\nYReal = 1\n", swapped),
              ElementsAre(HasSubstr("a height of -2e+30 m is none of a microscope")));
}

// Same image with another value of a key in its header.
std::string altered(const std::string& image, const std::string& key, const std::string& value) {
  constexpr std::size_t kHeader = 4096;
  std::string header = image.substr(0, kHeader);
  const std::size_t at = header.find(key) + key.size(), end = header.find("\r\n", at);
  header.replace(at, end - at, value);
  header.resize(kHeader);
  return header + image.substr(kHeader);
}

TEST(LabImageFiles, AreRefusedWhereAnAlteredHeaderWouldGiveOtherHeights) {
  const std::string whole = test::nanoscope_file("0x08150300", {nanoscope("Height", 4, 2)});
  const auto reason = [&](const std::string& key, const std::string& value) {
    const auto read = parse_image(altered(whole, key, value), "a.spm");
    return read ? "accepted" : read.error().message;
  };
  EXPECT_THAT(reason("\\Data offset: ", "20"), HasSubstr("its data begin at byte 20, within its header"));
  EXPECT_THAT(reason("\\Data offset: ", "-1"), HasSubstr("within its header"));
  EXPECT_THAT(reason("\\@Sens. Zsens: V ", "0 nm/V"), HasSubstr("its \"Sens. Zsens\" is 0"));
}

// As of a program that changes the header, but not the data.
TEST(LabImageFiles, RemarkOnPointsThatTheHeaderDoesNotMention) {
  const test::NanoscopeChannel height = nanoscope("Height", 4, 4);
  const std::string whole = test::nanoscope_file("0x08150300", {height}),
                    both = test::nanoscope_file("0x08150300", {height, height});
  for (const std::string& honest : {whole, both, whole + std::string(31, ' ')})
    EXPECT_THAT(parsed(honest).remarks, IsEmpty());
  const auto halved = [](std::string bytes, const std::string& key, const char* half) {
    return altered(altered(bytes, key, half), "\\Data length: ", "16");
  };
  for (const auto& bytes : {halved(whole, "\\Number of lines: ", "2"), halved(whole, "\\Samps/line: ", "2"),
                            halved(both, "\\Number of lines: ", "2")}) {
    EXPECT_THAT(parsed(bytes).remarks,
                testing::Contains(HasSubstr("points of Height lie 16 bytes that the header does not")));
  }
}

TEST(LabImageFiles, HaveTheirHeightsWhateverTheUnitOfASensitivity) {
  const std::string whole = test::nanoscope_file("0x08150300", {nanoscope("Height", 4, 2)});
  const double height_m = parsed(whole).image.channels.at(0).values.at(3);
  for (const char* same : {"+12.5 nm/V", "12.5 pm/mV", "0.0125 nm/mV", "0.0125 um/V"}) {
    const LoadedImage read = parsed(altered(whole, "\\@Sens. Zsens: V ", same));
    EXPECT_EQ(read.image.channels.at(0).unit, "m") << same;
    EXPECT_NEAR(read.image.channels.at(0).values.at(3) / height_m, 1.0, 1e-12) << same;
  }
}

TEST(LabImageFiles, MayBeInAngstroms) {
  for (const char* unit : {"\xC3\x85", "\xE2\x84\xAB", "\xC5"}) {
    const auto image = parse_image(
        test::gsf_file(
            fmt::format("XRes = 2\nYRes = 2\nXReal = 20\nYReal = 20\nXYUnits = {}\nZUnits = {}\n", unit, unit),
            {1, 2, 3, 4}),
        "a.gsf");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_DOUBLE_EQ(image->image.width_m, 2e-9);
    EXPECT_EQ(image->image.channels[0].unit, "m");
    EXPECT_NEAR(image->image.channels[0].values[3], 4e-10, 1e-24);
  }
}

}  // namespace lab_images_test
}  // namespace afm::curves
