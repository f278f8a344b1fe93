// SPDX-License-Identifier: Apache-2.0
#include "curves/measured_topography.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/image_files.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace measured_topography_test {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

std::string write(const support::ScratchFolder& folder, const std::string& bytes) {
  std::ofstream(folder.file("scan"), std::ios::binary) << bytes;
  return folder.file("scan");
}

std::string gsf(int columns, int rows, double width_m, double height_m, const std::vector<float>& values,
                const std::string& more = "ZUnits = m\n") {
  return test::gsf_file("XRes = " + std::to_string(columns) + "\nYRes = " + std::to_string(rows) +
                            "\nXReal = " + std::to_string(1e9 * width_m) +
                            "\nYReal = " + std::to_string(1e9 * height_m) + "\nXYUnits = nm\n" + more,
                        values);
}

TEST(MeasuredTopography, CannotCommandATerminalByItsTexts) {
  const support::ScratchFolder folder;
  const std::string bytes = gsf(2, 2, 1e-6, 1e-6, {1, 2, 3, 4}, "ZUnits = m\nTitle = evil\x1b[2Jname\n");
  const auto evil = load_topography(write(folder, bytes), {});
  ASSERT_TRUE(evil) << evil.error().message;
  EXPECT_THAT(topography_text(*evil), HasSubstr("evil\uFFFD[2Jname"));
}

TEST(MeasuredTopography, IsNoSampleIfItIsSmallerThanAnAtom) {
  const support::ScratchFolder folder;
  const std::string header = "XRes = 2\nYRes = 2\nXReal = 1e-30\nYReal = 1e-30\nXYUnits = m\nZUnits = m\n";
  const auto tiny = load_topography(write(folder, test::gsf_file(header, {0, 1e-9F, 2e-9F, 0})), {});
  ASSERT_TRUE(tiny) << tiny.error().message;
  const auto felt = felt_topography(*tiny);
  ASSERT_FALSE(felt);
  EXPECT_EQ(felt.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(felt.error().message, HasSubstr("smaller than an atom"));
}

TEST(MeasuredTopography, IsLevelledAndKeepsTheRaw) {
  const support::ScratchFolder folder;
  std::vector<float> tilted;
  for (int i = 0; i < 12; ++i) tilted.push_back(static_cast<float>(1e-9 * (i % 4) + (i == 5 ? 3e-9 : 0.0)));
  const auto found = load_topography(write(folder, gsf(4, 3, 40e-9, 30e-9, tilted)), {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_FLOAT_EQ(static_cast<float>(found->channel().values[5]), tilted[5]);
  EXPECT_LT(found->levelled.sq, found->raw.sq);
  const auto json = topography_json(*found);
  EXPECT_EQ(json["levelling"], "plane");
  EXPECT_EQ(json["columns"], 4);
  EXPECT_NEAR(json["slope_x"].get<double>(), 0.1, 0.03) << "a nanometre a pixel of ten";
  EXPECT_NEAR(json["mean"].get<double>(), found->raw.mean, 0.0);
  EXPECT_THAT(topography_text(*found), HasSubstr("4 x 3 points, 40 nm x 30 nm"));
}

TEST(MeasuredTopography, IsFeltPointByPointWhereItsPixelsAreSquare) {
  const support::ScratchFolder folder;
  const std::vector<float> values{1e-9F, 2e-9F, 3e-9F, 4e-9F, 5e-9F, 6e-9F, 7e-9F, 8e-9F, 9.5e-9F};
  const auto found = load_topography(write(folder, gsf(3, 3, 30e-9, 30e-9, values)), {{}, physics::Levelling::None});
  ASSERT_TRUE(found) << found.error().message;
  const auto felt = felt_topography(*found);
  ASSERT_TRUE(felt) << felt.error().message;
  EXPECT_EQ(felt->columns, 3U);
  EXPECT_NEAR(felt->spacing_m, 10e-9, 1e-15);
  EXPECT_NEAR(felt->height_m[0], 2e-9, 1e-15) << "the bottom row first, 0 at the origin";
  EXPECT_EQ(felt->height_m[4], 0.0F);
  EXPECT_NEAR(felt->height_m[8], -2e-9, 1e-15);
}

TEST(MeasuredTopography, IsResampledWhereItsPixelsAreNotSquareOrTooMany) {
  const support::ScratchFolder folder;
  std::vector<float> ramp;
  for (int i = 0; i < 64 * 16; ++i) ramp.push_back(static_cast<float>(1e-9 * (i % 64)));
  const auto wide = load_topography(write(folder, gsf(64, 16, 64e-9, 64e-9, ramp)), {{}, physics::Levelling::None});
  ASSERT_TRUE(wide) << wide.error().message;
  const auto square = felt_topography(*wide);
  ASSERT_TRUE(square);
  EXPECT_EQ(square->columns, 64U);
  EXPECT_EQ(square->rows, 64U);
  EXPECT_NEAR(square->height_m[10 * 64 + 40] - square->height_m[10 * 64 + 20], 20e-9, 1e-13);

  std::vector<float> large(1500 * 1200);
  for (std::size_t i = 0; i < large.size(); ++i) large[i] = static_cast<float>(1e-10 * static_cast<double>(i % 1500));
  const auto many =
      load_topography(write(folder, gsf(1500, 1200, 15e-6, 12e-6, large)), {{}, physics::Levelling::None});
  ASSERT_TRUE(many) << many.error().message;
  const auto fewer = felt_topography(*many);
  ASSERT_TRUE(fewer);
  EXPECT_EQ(fewer->columns, 1024U);
  EXPECT_EQ(fewer->rows, 819U);
  EXPECT_NEAR(fewer->spacing_m, 15e-6 / 1024.0, 1e-12);
  EXPECT_NEAR(fewer->height_m[400 * 1024 + 900] - fewer->height_m[400 * 1024 + 100], 1e-10 * 800 * 1500 / 1024, 1e-10);
}

TEST(MeasuredTopography, IsNoSampleWhereItIsNoHeight) {
  const support::ScratchFolder folder;
  const auto volts = load_topography(write(folder, gsf(2, 2, 1e-6, 1e-6, {1, 2, 3, 4}, "ZUnits = V\n")), {});
  ASSERT_TRUE(volts) << volts.error().message;
  EXPECT_THAT(felt_topography(*volts).error().message, HasSubstr("is in V, not a height"));
  const auto huge =
      load_topography(write(folder, test::gsf_file("XRes = 2\nYRes = 2\nZUnits = m\n", {0, 0, 0, 0})), {});
  ASSERT_TRUE(huge) << huge.error().message;
  EXPECT_THAT(felt_topography(*huge).error().message, HasSubstr("larger than a scan")) << "no XReal: 1 m";
  const auto tall = load_topography(write(folder, gsf(2, 2, 1e-6, 5e-3, {0, 1e-9F, 0, 0})), {});
  ASSERT_TRUE(tall) << tall.error().message;
  EXPECT_THAT(felt_topography(*tall).error().message,
              AllOf(HasSubstr("1 um x 5 mm"), HasSubstr("larger than a scan is, up to 1 mm; set its size")));
  EXPECT_THAT(tall->file.remarks, Contains(HasSubstr("its pixels are 5000 times as high as wide")));
  const auto profile = load_topography(write(folder, gsf(1, 4, 1e-8, 1e-6, {0, 1, 2, 3})), {});
  ASSERT_FALSE(profile);
  EXPECT_THAT(profile.error().message, HasSubstr("points on a side: 1; 2 to 8192 are read: it is a profile"));
  const auto blank = load_topography(write(folder, gsf(2, 2, 1e-6, 1e-6, {NAN, NAN, NAN, NAN})), {});
  ASSERT_FALSE(blank);
  EXPECT_EQ(blank.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(blank.error().message, HasSubstr("no point"));
}

}  // namespace measured_topography_test
}  // namespace afm::curves
