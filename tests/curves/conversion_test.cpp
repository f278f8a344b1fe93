// SPDX-License-Identifier: Apache-2.0
// Curves and images in another format, read again.
// Invariant: a converted curve has the points, calibration and place of the original, or a remark on what is lost
#include "curves/conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

#include "curves/curve_series.h"
#include "curves/image_file.h"
#include "support/archives/jpk_map.h"
#include "support/archives/stored_zip.h"
#include "support/image_files.h"
#include "support/places.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"
#include "vendor_image_files.h"

namespace afm::curves {
namespace conversion_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string path_of(const std::string& name) { return support::source("tests/data/afm/" + name); }

Converted made(const std::string& file, const std::string& name, const ConversionOptions& options = {}) {
  auto result = converted(file, name, options);
  EXPECT_TRUE(result.has_value()) << result.error().message;
  return result ? std::move(*result) : Converted{};
}

std::string refusal(const std::string& file, const std::string& name, const ConversionOptions& options = {}) {
  const auto result = converted(file, name, options);
  return result ? "accepted" : result.error().message;
}

CurveReading curve_of(std::size_t index) {
  CurveReading reading;
  reading.index = index;
  return reading;
}

ConversionOptions only(std::size_t index) {
  ConversionOptions options;
  options.index = index;
  return options;
}

ConversionOptions channel(const std::string& name) {
  ConversionOptions options;
  options.channel = name;
  return options;
}

void expect_same_place(const CurveMetadata& a, const CurveMetadata& b) {
  ASSERT_EQ(a.position.has_value(), b.position.has_value());
  ASSERT_EQ(a.pixel.has_value(), b.pixel.has_value());
  if (a.position) {
    EXPECT_EQ(a.position->x_m, b.position->x_m);
    EXPECT_EQ(a.position->y_m, b.position->y_m);
  }
  if (!a.pixel) return;
  EXPECT_EQ(a.pixel->column, b.pixel->column);
  EXPECT_EQ(a.pixel->row, b.pixel->row);
  EXPECT_EQ(a.pixel->grid.columns, b.pixel->grid.columns);
  EXPECT_EQ(a.pixel->grid.height_m, b.pixel->grid.height_m);
  EXPECT_EQ(a.pixel->grid.center_y_m, b.pixel->grid.center_y_m);
}

void expect_same(const RecordedCurve& a, const RecordedCurve& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    ASSERT_EQ(a.points[i].z.si, b.points[i].z.si) << i;
    ASSERT_EQ(a.points[i].force.si, b.points[i].force.si) << i;
    ASSERT_EQ(a.points[i].branch, b.points[i].branch) << i;
  }
  EXPECT_EQ(a.time_s, b.time_s);
  EXPECT_EQ(a.metadata.spring_constant.has_value(), b.metadata.spring_constant.has_value());
  if (a.metadata.spring_constant && b.metadata.spring_constant) {
    EXPECT_EQ(a.metadata.spring_constant->si, b.metadata.spring_constant->si);
  }
  EXPECT_EQ(a.metadata.sensitivity_m_per_v, b.metadata.sensitivity_m_per_v);
  EXPECT_EQ(a.metadata.instrument, b.metadata.instrument);
  EXPECT_EQ(a.metadata.date, b.metadata.date);
  EXPECT_EQ(a.metadata.curve_id, b.metadata.curve_id);
  EXPECT_EQ(a.metadata.parameters, b.metadata.parameters);
  expect_same_place(a.metadata, b.metadata);
}

constexpr std::array kCurveNames{"dwell.ibw",          "rising.tab", "bom.tab",
                                 "comment-commas.csv", "uneven.csv", "short-approach-dwell.jpk-force",
                                 "segments-012.tab"};

TEST(Conversion, KeepsCurvesToTheLastBit) {
  for (const char* name : kCurveNames) {
    const auto original = load_curve(path_of(name));
    ASSERT_TRUE(original.has_value()) << original.error().message;
    for (const char* format : {"new.tab", "new.h5"}) {
      SCOPED_TRACE(std::string(name) + " as " + format);
      const Converted result = made(path_of(name), format);
      const auto back = parse_curve(result.bytes, format);
      ASSERT_TRUE(back.has_value()) << back.error().message;
      expect_same(*original, *back);
      EXPECT_THAT(result.remarks, Not(Contains(HasSubstr("differ by"))));
    }
  }
}

TEST(Conversion, NamesWhatTheReaderLeftOut) {
  EXPECT_THAT(made(path_of("rising.tab"), "new.tab").remarks, Contains(HasSubstr("counted the other way")));
  EXPECT_THAT(made(path_of("dwell.ibw"), "new.h5").contents, "1 curve of 400 points");
}

TEST(Conversion, SaysWhatEvenHeightsChange) {
  const Converted result = made(path_of("dwell.ibw"), "new.csv");
  EXPECT_THAT(result.remarks, Contains(HasSubstr("as afm-workshop, heights differ by at most ")));
  EXPECT_TRUE(parse_curve(result.bytes, "new.csv").has_value());
}

TEST(Conversion, WritesAllCurvesOfAMapOrOne) {
  const support::ScratchFolder folder;
  const std::string map =
      folder.write("a.jpk-force-map",
                   test::stored_zip(test::jpk_map([](std::size_t index) { return test::hertz_curve(50 + index); })));
  const Converted all = made(map, "new.h5");
  EXPECT_THAT(all.contents, HasSubstr("6 curves of "));
  const std::string written = folder.write("new.h5", all.bytes);
  ASSERT_EQ(curve_count(written).value(), 6U);
  read_curves(written, 6, {}, {}, [&](std::size_t index, const core::Result<RecordedCurve>& curve) {
    EXPECT_TRUE(curve.has_value()) << index;
    const auto original = load_curve(map, curve_of(index));
    if (curve && original) expect_same(*original, *curve);
    return true;
  });
  EXPECT_THAT(refusal(map, "new.tab"), HasSubstr("has 6 curves, and new.tab holds one: choose it by --curve INDEX"));
  const auto one = parse_curve(made(map, "new.tab", only(3)).bytes, "new.tab");
  ASSERT_TRUE(one.has_value());
  expect_same(*load_curve(map, curve_of(3)), *one);
  const auto workshop = parse_curve(made(map, "new.csv", only(3)).bytes, "new.csv");
  ASSERT_TRUE(workshop.has_value()) << workshop.error().message;
  expect_same_place(load_curve(map, curve_of(3))->metadata, workshop->metadata);
  EXPECT_EQ(workshop->metadata.pixel->column, test::map_column(3));
  EXPECT_THAT(refusal(map, "new.tab", only(6)), HasSubstr("it has no curve 6; it has 6, counted from 0"));
}

TEST(Conversion, KeepsEveryChannelOfAnImage) {
  const Converted result = made(path_of("qnm-log.spm"), "new.gwy");
  EXPECT_EQ(result.contents, "2 channels of 16 x 12 points");
  const auto original = load_image(path_of("qnm-log.spm"));
  const auto back = parse_image(result.bytes, "new.gwy");
  ASSERT_TRUE(original && back);
  ASSERT_EQ(back->image.channels.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back->image.channels[i].name, original->image.channels[i].name);
    EXPECT_EQ(back->image.channels[i].unit, original->image.channels[i].unit);
    EXPECT_EQ(back->image.channels[i].values, original->image.channels[i].values);
  }
  EXPECT_EQ(back->image.width_m, original->image.width_m);
  EXPECT_EQ(back->image.height_m, original->image.height_m);
  EXPECT_THAT(made(path_of("one-empty-channel.spm"), "new.gwy").remarks,
              ElementsAre(HasSubstr("Input2 is left out: points on a side: 0")));
}

TEST(Conversion, WritesOneChannelWithItsLossNamed) {
  const support::ScratchFolder folder;
  const std::string file = folder.write("scan.nid", test::nanosurf_file({{}, {.group = "Scan backward"}}));
  const Converted result = made(file, "new.gsf", channel("z-axis (retrace)"));
  EXPECT_EQ(result.contents, "Z-Axis (retrace), 3 x 2 points");
  EXPECT_THAT(result.remarks, ElementsAre("a .gsf holds one channel, its numbers with seven digits"));
  const auto back = parse_image(result.bytes, "new.gsf");
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR(back->image.channels.at(0).values.at(0), 10e-9, 1e-15);
}

TEST(Conversion, RefusesWhatAFormatDoesNotHold) {
  EXPECT_THAT(refusal(path_of("bom.tab"), "new.gwy"), HasSubstr("has curves, and new.gwy is no name for them"));
  EXPECT_THAT(refusal(path_of("qnm-log.spm"), "new.tab"), HasSubstr("is an image, and new.tab is no name for one"));
  EXPECT_THAT(refusal(path_of("bom.tab"), "new.xyz"), HasSubstr(kConvertedFiles));
  EXPECT_THAT(refusal(path_of("bom.tab"), "new.tab", channel("Height")), HasSubstr("--channel is for images"));
  EXPECT_THAT(refusal(path_of("qnm-log.spm"), "new.gwy", only(1)), HasSubstr("--curve, --spring-constant"));
  EXPECT_THAT(refusal(path_of("missing.tab"), "new.tab"), HasSubstr("missing.tab"));
}

// whatever the name of the new file
TEST(Conversion, SaysWhatAFileOfNoKindIs) {
  const support::ScratchFolder folder;
  const std::string picture = folder.write("a.png", "\x89PNG\r\n\x1a\n"), table = folder.write("a.txt", "1 2\n3 4\n");
  for (const char* name : {"new.gwy", "new.tab", "new.xyz"}) {
    EXPECT_THAT(refusal(picture, name), HasSubstr("a.png: it is a PNG")) << name;
    EXPECT_THAT(refusal(table, name), HasSubstr("a table of numbers needs --columns")) << name;
  }
}

TEST(Conversion, TakesAnEndingInCapitals) {
  const auto tab = converted(path_of("bom.tab"), "NEW.TAB", {});
  EXPECT_TRUE(tab) << tab.error().message;
  const auto gsf = converted(path_of("qnm-log.spm"), "NEW.GSF", {});
  EXPECT_TRUE(gsf) << gsf.error().message;
}

}  // namespace conversion_test
}  // namespace afm::curves
