// SPDX-License-Identifier: Apache-2.0
// A map of force curves, felt pixel by pixel.
// Invariant: a pixel of a map feels the same as its curve alone
#include "curves/curve_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "curves/curve_file.h"
#include "curves/fitting/fitted_curve.h"
#include "curves/fitting/map_fit.h"
#include "curves/live_parameters.h"
#include "scene/samples/material_library.h"
#include "support/archives/sticky_map.h"
#include "support/archives/stored_zip.h"
#include "support/places.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace curve_map_test {

using core::ErrorCategory;
using testing::ElementsAre;
using testing::HasSubstr;
using Row = LiveParameters::Row;

const CurveMap::Progress kGoOn = [](std::size_t, std::size_t) { return true; };

const scene::MaterialEntry& mica() {
  static const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  return *library.find("mica");
}

class ForceMap : public testing::Test {
 protected:
  std::string write(const std::map<std::string, std::string>& entries) const {
    return folder_.write("gel.jpk-force-map", test::stored_zip(entries));
  }
  std::shared_ptr<const CurveMap> load(const std::map<std::string, std::string>& entries) const {
    auto map = CurveMap::load(write(entries), kGoOn);
    if (!map) throw std::runtime_error(map.error().message);
    return std::make_shared<const CurveMap>(std::move(*map));
  }
  core::Error refusal(const std::string& path) const {
    const auto map = CurveMap::load(path, kGoOn);
    if (map) throw std::runtime_error("the map is not refused");
    return map.error();
  }

  const support::ScratchFolder folder_;
};

void expect_same(const scene::SharedMeasuredCurve& a, const scene::SharedMeasuredCurve& b) {
  ASSERT_EQ(a.approach_count, b.approach_count);
  ASSERT_EQ(a.retract_count, b.retract_count);
  EXPECT_EQ(a.jumps.approach, b.jumps.approach);
  EXPECT_EQ(a.jumps.retract, b.jumps.retract);
  for (std::size_t i = 0; i < a.approach_count; ++i) {
    EXPECT_EQ(a.approach[i].z.si, b.approach[i].z.si);
    EXPECT_EQ(a.approach[i].force.si, b.approach[i].force.si);
  }
  for (std::size_t i = 0; i < a.retract_count; ++i) {
    EXPECT_EQ(a.retract[i].z.si, b.retract[i].z.si);
    EXPECT_EQ(a.retract[i].force.si, b.retract[i].force.si);
  }
}

TEST_F(ForceMap, IsReadWithTheCalibrationThatIsGiven) {
  const std::string path = write(test::jpk_map(test::sticky_curve));
  CurveReading calibration;
  calibration.spring_constant = physics::Stiffness(1.1);  // twice the value of the file
  const auto own = CurveMap::load(path, kGoOn), given = CurveMap::load(path, kGoOn, calibration);
  ASSERT_TRUE(own && given);
  const auto before = own->material({1, 0}, mica()), after = given->material({1, 0}, mica());
  ASSERT_TRUE(before && after);
  EXPECT_DOUBLE_EQ(before->entry.contact.spring_constant.si, 0.55);
  EXPECT_DOUBLE_EQ(after->entry.contact.spring_constant.si, 1.1);
  ASSERT_TRUE(before->features.adhesion && after->features.adhesion);
  EXPECT_NEAR(after->features.adhesion->force.si / before->features.adhesion->force.si, 2.0, 1e-6);
}

TEST_F(ForceMap, HasTheFitOfEachCurveAndWithoutAFitNone) {
  FitOptions options;
  options.shape = fits::Shape::Paraboloid;
  options.radius_m = test::kHertzRadiusM;
  ASSERT_TRUE(prepare(options));
  auto entries = test::jpk_map([](std::size_t) { return test::hertz_curve(200); });
  entries["index/2/segments/1/channels/vDeflection.dat"].pop_back();  // curve at the lower right
  const std::string path = write(entries);
  EXPECT_TRUE(CurveMap::load(path, kGoOn).value().fits().empty());
  const auto map = CurveMap::load(path, kGoOn, {}, fit_of_each(path, options));
  ASSERT_TRUE(map) << map.error().message;
  ASSERT_EQ(map->fits().size(), 6U);
  const PixelFit &hole = map->fits()[5], &fitted = map->fits()[3];
  EXPECT_FALSE(map->has_curve({2, 0}));
  EXPECT_FALSE(hole.usable());
  EXPECT_TRUE(std::isnan(hole.modulus_pa));
  EXPECT_THAT(fits_text(*map), HasSubstr("; 0 curves have none"));
  ASSERT_TRUE(fitted.usable()) << fits_text(*map);
  EXPECT_NEAR(fitted.modulus_pa, test::kHertzModulusPa, 0.02 * test::kHertzModulusPa);

  CurveReading reading;
  reading.index = 0;  // curve at the lower left
  const FittedCurve alone = fitted_curve(path, load_curve(path, reading), options);
  ASSERT_TRUE(alone.fit) << alone.why;
  EXPECT_EQ(fitted.modulus_pa, alone.fit->modulus_pa);
  EXPECT_EQ(fitted.trust, alone.fit->trust);
}

TEST_F(ForceMap, HasTheCurveOfEachPixelAsItIsReadAlone) {
  const auto map = load(test::jpk_map(test::sticky_curve));
  for (std::size_t index = 0; index < 6; ++index) {
    const MapPlace place{test::map_column(index), test::map_row(index)};
    const auto pixel = map->material(place, mica());
    ASSERT_TRUE(pixel) << pixel.error().message;
    // the same curve in a separate file, whose format loses no bit
    const std::string alone = folder_.file("alone.tab");
    CurveReading reading;
    reading.index = index;
    ASSERT_TRUE(write_curve(alone, CurveFormat::Tab, load_curve(map->path(), reading).value()));
    const auto measured = load_measured_material(alone, mica());
    ASSERT_TRUE(measured) << measured.error().message;
    expect_same(pixel->curve, measured->curve);
    EXPECT_EQ(pixel->entry.contact.spring_constant.si, measured->entry.contact.spring_constant.si);
    EXPECT_EQ(pixel->curve.column, static_cast<std::int32_t>(place.column));
    EXPECT_EQ(pixel->curve.row, static_cast<std::int32_t>(place.row));
    EXPECT_EQ(pixel->entry.title, "gel (" + text_of(place) + ")");
  }
}

TEST_F(ForceMap, ShowsTheHeightsFromTheTop) {
  const auto map = load(test::jpk_map(test::sticky_curve));
  EXPECT_EQ(map->grid().columns, 3U);
  EXPECT_EQ(map->grid().rows, 2U);
  ASSERT_EQ(map->heights_m().size(), 6U);
  const double lowest_m = map->heights_m()[3];  // curve 0, at the bottom left
  const std::vector<double> steps{5, 4, 3, 0, 1, 2};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(map->heights_m()[i] - lowest_m, 10e-9 * steps[i], 1e-12) << i;
  EXPECT_EQ(map->middle(), (MapPlace{1, 1}));
}

TEST_F(ForceMap, RefusesAPixelThatItLacks) {
  const auto map = load(test::holed_map());
  const auto outside = map->material({3, 0}, mica());
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().category, ErrorCategory::WrongUsage);
  EXPECT_THAT(outside.error().message, HasSubstr("columns are 0 to 2, its rows 0 to 1"));
  const auto hole = map->material({2, 0}, mica());
  ASSERT_FALSE(hole);
  EXPECT_EQ(hole.error().category, ErrorCategory::BadInputFile);
  EXPECT_THAT(hole.error().message, HasSubstr("has no curve at pixel 2,0"));
  EXPECT_TRUE(std::isnan(map->heights_m()[5]));
}

// Few curves extracted from a map of quantitative imaging.
TEST_F(ForceMap, OfAFewCurvesOnALargeGridHasPixelsWithoutOne) {
  const auto map = load(test::on_finer_grid(test::jpk_map(test::sticky_curve), 129));
  EXPECT_EQ(map->grid().columns, 387U);
  EXPECT_EQ(map->grid().rows, 258U);
  EXPECT_EQ(map->pixels_with_curve(), 6U);
  const auto& heights = map->heights_m();
  EXPECT_EQ(std::count_if(heights.begin(), heights.end(), [](double m) { return std::isfinite(m); }), 6);
  EXPECT_TRUE(map->has_curve(map->middle()));
  EXPECT_TRUE(map->material({129 * 2 + 64, 64}, mica()));
  EXPECT_THAT(map->material({0, 0}, mica()).error().message, HasSubstr("has no curve at pixel 0,0"));
  EXPECT_THAT(refusal(write(test::on_finer_grid(test::jpk_map(test::sticky_curve), 1025))).message,
              HasSubstr("it has 6 curves on a grid of 3075 x 2050 pixels"));
}

TEST_F(ForceMap, RefusesAPixelWithoutContactWithTheReason) {
  const auto map = load(test::jpk_map([](std::size_t index) {
    RecordedCurve curve = test::sticky_curve(index);
    if (index == 1) {
      for (auto& point : curve.points) point.force = physics::Force();
    }
    return curve;
  }));
  const auto flat = map->material({1, 0}, mica());
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().category, ErrorCategory::BadInputFile);
  EXPECT_THAT(flat.error().message, HasSubstr("pixel 1,0: "));
}

TEST_F(ForceMap, IsRefusedIfItIsCutOrNoMap) {
  const std::string bytes = test::stored_zip(test::jpk_map(test::sticky_curve));
  const core::Error cut = refusal(folder_.write("cut.jpk-force-map", bytes.substr(0, bytes.size() / 2)));
  EXPECT_EQ(cut.category, ErrorCategory::BadInputFile);
  EXPECT_THAT(cut.message, HasSubstr("it is cut short: its zip archive has no end; copy"));
  const std::string single = folder_.file("single.tab");
  ASSERT_TRUE(write_curve(single, CurveFormat::Tab, test::hertz_curve(50)));
  EXPECT_THAT(refusal(single).message, HasSubstr("it holds only one curve"));
  auto nowhere = test::jpk_map(test::sticky_curve);
  nowhere["header.properties"] = "";
  EXPECT_THAT(refusal(write(nowhere)).message, HasSubstr("its curves are not on a grid"));
  auto broken = test::jpk_map(test::sticky_curve);
  for (auto& [name, content] : broken) {
    if (name.ends_with("vDeflection.dat")) content.pop_back();
  }
  EXPECT_THAT(refusal(write(broken)).message, HasSubstr("no curve of it can be read; the first: "));
}

TEST_F(ForceMap, EndsWhenNobodyWantsMore) {
  const auto map =
      CurveMap::load(write(test::jpk_map(test::sticky_curve)), [](std::size_t read, std::size_t) { return read < 2; });
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().category, ErrorCategory::Failed);
}

TEST_F(ForceMap, IsWalkedOverPixelByPixel) {
  const auto map = load(test::holed_map());
  const SampleModel loaded = make_sample_model(map, {0, 0}, mica()).value();
  LiveParameters pixels(loaded);
  EXPECT_THAT(pixels.rows(), ElementsAre(Row::PixelColumn, Row::PixelRow));
  EXPECT_FALSE(pixels.step(Row::PixelColumn, -1));
  EXPECT_FALSE(pixels.refusal().empty());
  ASSERT_TRUE(pixels.step(Row::PixelColumn, 1));
  EXPECT_EQ(pixels.model().pixel->place, (MapPlace{1, 0}));
  expect_same(pixels.model().pixel->measured.curve, map->material({1, 0}, mica())->curve);
  EXPECT_FALSE(pixels.step(Row::PixelColumn, 1)) << "the hole, and behind it the end";
  ASSERT_TRUE(pixels.step(Row::PixelRow, 1));
  EXPECT_EQ(pixels.model().pixel->place, (MapPlace{1, 1}));
  EXPECT_EQ(pixels.value(Row::PixelRow), "1");

  LiveParameters other(loaded);  // parameters on another machine of the wall
  ASSERT_TRUE(other.restore(pixels.state()));
  EXPECT_EQ(other.model().pixel->place, (MapPlace{1, 1}));
  LiveParameters::State foreign = pixels.state();
  foreign.steps[static_cast<std::size_t>(Row::Hamaker)] = 1;
  EXPECT_FALSE(other.restore(foreign));

  ASSERT_TRUE(pixels.choose({2, 1}));
  EXPECT_EQ(pixels.model().pixel->place, (MapPlace{2, 1}));
  EXPECT_FALSE(pixels.choose({2, 0}));
  EXPECT_EQ(pixels.model().pixel->place, (MapPlace{2, 1}));
  EXPECT_TRUE(pixels.refusal().empty());
  EXPECT_TRUE(pixels.reset());
  EXPECT_EQ(pixels.model().pixel->place, (MapPlace{0, 0}));
}

TEST(MapPlaces, AreReadAsTheyAreWritten) {
  EXPECT_EQ(parse_map_place("3,12"), (MapPlace{3, 12}));
  EXPECT_EQ(text_of({3, 12}), "3,12");
  for (const char* wrong : {"", "3", "3,", ",3", "3,-1", "3, 1", "3,1,2", "a,b"})
    EXPECT_FALSE(parse_map_place(wrong)) << wrong;
}

TEST(TitleOfAFile, HasNoUnderscoreWhichWouldBeginASubscript) {
  EXPECT_EQ(title_of("day 1/fd_map_2.jpk-force-map"), "fd map 2");
}

}  // namespace curve_map_test
}  // namespace afm::curves
