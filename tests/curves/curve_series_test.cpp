// SPDX-License-Identifier: Apache-2.0
// Files with several curves: JPK's maps, and .h5.
#include "curves/curve_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "formats/handed_curve.h"
#include "formats/tab_file.h"
#include "support/archives/jpk_map.h"
#include "support/archives/stored_zip.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace curve_series_test {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kRiseM = 10e-9;  // rise of the contact from one curve to the next

RecordedCurve risen(std::size_t index) {
  RecordedCurve curve = test::hertz_curve(50);
  for (auto& point : curve.points) point.z = point.z + physics::Length(static_cast<double>(index) * kRiseM);
  return curve;
}

struct Read {
  std::vector<std::size_t> indexes;
  std::vector<core::Result<RecordedCurve>> curves;
};

Read read_part(const std::string& path, std::size_t count, const SeriesPart& part, std::size_t most = 100) {
  Read read;
  read_curves(path, count, part, {}, [&](std::size_t index, core::Result<RecordedCurve> curve) {
    read.indexes.push_back(index);
    read.curves.push_back(std::move(curve));
    return read.indexes.size() < most;
  });
  return read;
}

// The curve comes from the confined child that reads it.
TEST(HandedCurve, IsTheSameBitForBitAndWhole) {
  RecordedCurve curve = risen(3);
  for (std::size_t i = 0; i < curve.points.size(); ++i) curve.time_s.push_back(static_cast<double>(i) / 3.0);
  curve.points[5].force = physics::Force(1.0 / 3.0 * 1e-9);
  curve.metadata.remarks = {"it is a test"};
  curve.metadata.position = CurvePosition{1e-6 / 7.0, -2e-6};
  curve.metadata.pixel = MapPixel{{8, 4, 1e-5, 5e-6, 0.0, -1e-6}, 3, 2};
  curve.metadata.instrument = "JPK";
  curve.metadata.parameters = {{"tip_radius_m", "5e-08"}};
  const std::string bytes = handed_bytes(curve);
  const RecordedCurve again = read_handed(bytes);
  ASSERT_EQ(again.points.size(), curve.points.size());
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    EXPECT_EQ(again.points[i].z, curve.points[i].z);
    EXPECT_EQ(again.points[i].force, curve.points[i].force);
    EXPECT_EQ(again.points[i].branch, curve.points[i].branch);
  }
  EXPECT_EQ(again.time_s, curve.time_s);
  EXPECT_EQ(again.metadata.remarks, curve.metadata.remarks);
  EXPECT_EQ(again.metadata.parameters, curve.metadata.parameters);
  EXPECT_EQ(again.metadata.position->x_m, curve.metadata.position->x_m);
  EXPECT_EQ(again.metadata.spring_constant, curve.metadata.spring_constant);
  ASSERT_TRUE(again.metadata.pixel.has_value());
  EXPECT_EQ(again.metadata.pixel->grid, curve.metadata.pixel->grid);
  EXPECT_EQ(again.metadata.pixel->column, 3U);
  EXPECT_EQ(again.metadata.instrument, "JPK");
  EXPECT_ANY_THROW(read_handed(tab_bytes(curve))) << "of a file, not of another process";
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_ANY_THROW(read_handed(std::string_view(bytes).substr(0, size))) << size;
  }
  for (std::size_t at = 1; at < 25; ++at) {
    std::string damaged = bytes;
    damaged[at] = '\x7f';
    try {
      read_handed(damaged);  // a count of which bytes are missing, or whether there are times
    } catch (const std::runtime_error&) {
      continue;
    }
    EXPECT_GE(at, 17U);
  }
}

TEST(HandedCurve, WithImpossibleMetadataIsRefused) {
  RecordedCurve curve = risen(3);
  curve.metadata.sensitivity_m_per_v = std::numeric_limits<double>::quiet_NaN();
  EXPECT_ANY_THROW(read_handed(handed_bytes(curve)));
  curve.metadata.sensitivity_m_per_v = 6e-8;
  curve.metadata.pixel = MapPixel{{8, 4, 1e-5, 5e-6, 0.0, 0.0}, 8, 2};
  EXPECT_ANY_THROW(read_handed(handed_bytes(curve))) << "column 8 of 8";
  curve.metadata.pixel.reset();
  curve.metadata.position = CurvePosition{std::numeric_limits<double>::infinity(), 0.0};
  EXPECT_ANY_THROW(read_handed(handed_bytes(curve)));
}

TEST(CurveSeries, OfAMapIsReadByPartsInOrder) {
  const support::ScratchFolder folder;
  const std::string path = folder.write("a.jpk-force-map", test::stored_zip(test::jpk_map(risen)));
  ASSERT_EQ(curve_count(path).value(), 6U);
  const Read odd = read_part(path, 6, {1, 2});
  EXPECT_THAT(odd.indexes, ElementsAre(1, 3, 5));
  for (std::size_t i = 0; i < odd.curves.size(); ++i) {
    ASSERT_TRUE(odd.curves[i]) << odd.curves[i].error().message;
    const RecordedCurve expected = risen(odd.indexes[i]);
    ASSERT_EQ(odd.curves[i]->points.size(), expected.points.size());
    EXPECT_NEAR(odd.curves[i]->points[7].z.si, expected.points[7].z.si, 1e-14);
    EXPECT_NEAR(odd.curves[i]->points[49].force.si, expected.points[49].force.si, 1e-17);
  }
  EXPECT_THAT(read_part(path, 6, {0, 1}, 2).indexes, ElementsAre(0, 1)) << "it goes on when nobody wants more";
}

TEST(CurveSeries, OfAMapKnowsEachPixelWhateverTheOrderOfRecording) {
  const support::ScratchFolder folder;
  const std::string path = folder.write("a.jpk-force-map", test::stored_zip(test::jpk_map(risen)));
  const Read all = read_part(path, 6, {0, 1});
  ASSERT_EQ(all.curves.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_TRUE(all.curves[i]) << all.curves[i].error().message;
    const auto& pixel = all.curves[i]->metadata.pixel;
    ASSERT_TRUE(pixel);
    EXPECT_EQ(pixel->column, test::map_column(i));
    EXPECT_EQ(pixel->row, test::map_row(i));
    EXPECT_EQ(pixel->grid.columns, test::kMapColumns);
    EXPECT_EQ(pixel->grid.rows, test::kMapRows);
    EXPECT_DOUBLE_EQ(pixel->grid.width_m, test::kMapWidthM);
    EXPECT_DOUBLE_EQ(pixel->grid.center_y_m, test::kMapYM);
  }
  EXPECT_NEAR(all.curves[5]->metadata.position->x_m, 9e-6, 1e-15);
  EXPECT_NEAR(all.curves[5]->metadata.position->y_m, -4.5e-6, 1e-15);
}

TEST(CurveSeries, LosesABrokenCurveAlone) {
  const support::ScratchFolder folder;
  auto entries = test::jpk_map(risen);
  entries["index/2/segments/1/channels/vDeflection.dat"].pop_back();
  const std::string path = folder.write("a.jpk-force-map", test::stored_zip(entries));
  const Read all = read_part(path, 6, {0, 1});
  ASSERT_EQ(all.curves.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(all.curves[i].has_value(), i != 2);
  EXPECT_THAT(all.curves[2].error().message, HasSubstr("\"vDeflection\" is cut short"));
}

TEST(CurveSeries, OfACutFileIsRefusedInOneLine) {
  const support::ScratchFolder folder;
  const std::string bytes = test::stored_zip(test::jpk_map(risen));
  for (const double share : {0.1, 0.5, 0.99}) {
    const auto cut = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
    const std::string path = folder.write("cut.jpk-force-map", bytes.substr(0, cut));
    const auto count = curve_count(path);
    ASSERT_FALSE(count) << share;
    EXPECT_EQ(count.error().category, core::ErrorCategory::BadInputFile);
    EXPECT_THAT(count.error().message,
                HasSubstr("it is cut short: its zip archive has no end; copy the file again from"));
    EXPECT_FALSE(load_curve(path));
  }
}

// The headers lie farther behind than the archive says.
TEST(CurveSeries, OfAnArchiveBehindOtherBytesIsRead) {
  const support::ScratchFolder folder;
  const std::string before = std::string("PK\x03\x04") + std::string(100, ' ');
  const std::string path = folder.write("a.jpk-force-map", before + test::stored_zip(test::jpk_map(risen)));
  const Read all = read_part(path, 6, {0, 1});
  ASSERT_EQ(all.curves.size(), 6U);
  for (const auto& curve : all.curves) EXPECT_TRUE(curve) << curve.error().message;
}

// Half an archive, whose headers say more than there is.
TEST(CurveSeries, OfHeadersThatLieIsRefusedOrRead) {
  const support::ScratchFolder folder;
  const std::string bytes = test::stored_zip(test::jpk_map(risen));
  const std::size_t first = bytes.find("PK\x01\x02");
  ASSERT_NE(first, std::string::npos);
  for (const std::size_t number : {28U, 30U, 32U}) {
    std::string lying(bytes);
    lying[first + number] = '\xff';
    lying[first + number + 1] = '\xff';
    const std::string path = folder.write("lying.jpk-force-map", lying);
    const auto count = curve_count(path);
    if (count) continue;
    EXPECT_EQ(count.error().category, core::ErrorCategory::BadInputFile) << number;
  }
}

TEST(CurveSeries, OfOneCurveIsThatCurve) {
  const support::ScratchFolder folder;
  for (const auto& [name, format] : {std::pair{"a.tab", CurveFormat::Tab}, std::pair{"a.h5", CurveFormat::Hdf5}}) {
    const std::string path = folder.file(name);
    ASSERT_TRUE(write_curve(path, format, risen(3)));
    EXPECT_EQ(curve_count(path).value(), 1U) << name;
    const Read read = read_part(path, 1, {0, 1});
    ASSERT_THAT(read.indexes, ElementsAre(0)) << name;
    ASSERT_TRUE(read.curves[0]) << read.curves[0].error().message;
    EXPECT_EQ(read.curves[0]->points.size(), 100U) << name;
  }
}

TEST(CurveSeries, HasOneCurveOfAMapByItsNumber) {
  const std::string bytes = test::stored_zip(test::jpk_map(risen));
  const auto curve = parse_curve(bytes, "a", {.spring_constant = {}, .sensitivity_m_per_v = {}, .index = 4});
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_NEAR(curve->points[0].z.si, 2e-6 + 4 * kRiseM, 1e-14);
  EXPECT_THAT(curve->metadata.remarks, testing::Contains("it is curve 4 of 6, counted from 0"));
  const auto beyond = parse_curve(bytes, "a", {.spring_constant = {}, .sensitivity_m_per_v = {}, .index = 6});
  ASSERT_FALSE(beyond);
  EXPECT_THAT(beyond.error().message, HasSubstr("it has no curve 6; it has 6, counted from 0"));
}

TEST(CurveSeries, KeepsPlaceAndPixelInEveryFormatOfAfmformats) {
  RecordedCurve curve = risen(0);
  curve.metadata.position = {1e-6, -2e-6};
  curve.metadata.pixel = {{16, 8, 4e-6, 2e-6, 0.5e-6, -1e-6}, 9, 3};
  for (const CurveFormat format : {CurveFormat::Tab, CurveFormat::Hdf5}) {
    const auto read = parse_curve(curve_bytes(format, curve).value(), "a");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->metadata.position->y_m, -2e-6);
    ASSERT_TRUE(read->metadata.pixel);
    EXPECT_TRUE(read->metadata.pixel->grid == curve.metadata.pixel->grid);
    EXPECT_EQ(read->metadata.pixel->column, 9U);
    EXPECT_EQ(read->metadata.pixel->row, 3U);
  }
}

TEST(MapPixel, FollowsAGridThatIsTurnedOrReflected) {
  const MapGrid grid{4, 2, 4e-6, 2e-6, 1e-6, 1e-6};
  const auto plain = pixel_at({2.5e-6, 1.5e-6}, grid);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->column, 3U);
  EXPECT_EQ(plain->row, 1U);
  EXPECT_EQ(pixel_at({2.5e-6, 1.5e-6}, grid, 0.0, true)->row, 0U);
  // a quarter turn counterclockwise: the grid's columns run along y
  const auto turned = pixel_at({0.5e-6, 2.5e-6}, grid, std::numbers::pi / 2);
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->column, 3U);
  EXPECT_EQ(turned->row, 1U);
  EXPECT_FALSE(pixel_at({3.1e-6, 1.5e-6}, grid));
  EXPECT_FALSE(pixel_at({2.5e-6, -0.1e-6}, grid));
}

}  // namespace curve_series_test
}  // namespace afm::curves
