// SPDX-License-Identifier: Apache-2.0
// Spectroscopy of Nanosurf, from files that are put together here as published readers describe them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "curves/curve_file.h"
#include "curves/curve_map.h"
#include "curves/curve_series.h"
#include "curves/image_file.h"
#include "damaged_curves.h"
#include "support/scratch_folder.h"
#include "vendor_image_files.h"

namespace afm::curves {
namespace nanosurf_curves_test {

using test::NanosurfChannel;
using testing::Contains;
using testing::HasSubstr;

constexpr int kPoints = 20, kCurves = 6;
constexpr double kForceStep_n = 1e-11, kHeightStep_m = 1e-9;

constexpr const char* kSpring = "\r\n[DataSet\\Calibration\\Cantilever]\r\nProp0=D[0.2]*[N/m]\r\n";
constexpr const char* kHead =
    "\r\n[DataSet\\Calibration\\Scanhead]\r\nIn5=5,TipSignalDC,Deflection,m,1.5e-06,0\r\n"
    "In15=16,TipSignalDC1,Deflection,V,10,0\r\n";
constexpr const char* kMap =
    "\r\n[DataSet\\SpecInfos\\SpecMapTable]\r\nCount=1\r\nMap0=-1e-6;1e-6;2e-6;3e-6;3;2;0;1\r\n";

// The contact lies after the fifteenth point of the approach, and rises by a step from curve to curve.
int height_at(int curve, int point) { return 10 * (kPoints - point) + curve; }
int force_at(int curve, int point) { return point > 14 ? 100 * (point - 14) * (curve + 1) : 0; }

NanosurfChannel channel(const std::string& group, const std::string& name, const std::string& unit,
                        int (*value)(int curve, int point)) {
  const double step = unit == "m" ? kHeightStep_m : kForceStep_n;
  NanosurfChannel made{.group = group, .name = name, .unit = unit, .columns = kPoints, .rows = kCurves, .numbers = {}};
  made.range = fmt::format("{}", 65536 * step);
  made.lowest = fmt::format("{}", -32768 * step);
  const bool back = group == "Spec backward";
  for (int curve = 0; curve < kCurves; ++curve) {
    for (int point = 0; point < kPoints; ++point) {
      test::append_little(made.numbers, static_cast<std::int16_t>(value(curve, back ? kPoints - 1 - point : point)));
    }
  }
  return made;
}

std::vector<NanosurfChannel> usual(const std::string& force_unit = "N") {
  return {
      channel("Spec forward", "Deflection", force_unit, force_at), channel("Spec forward", "Z-Axis", "m", height_at),
      channel("Spec backward", "Deflection", force_unit, force_at), channel("Spec backward", "Z-Axis", "m", height_at)};
}

core::Result<RecordedCurve> parse(const std::string& file, std::size_t index = 0, CurveReading reading = {}) {
  reading.index = index;
  reading.confined = false;
  return parse_curve(file, "a.nid", reading);
}

RecordedCurve read(const std::string& file, std::size_t index = 0, const CurveReading& reading = {}) {
  auto curve = parse(file, index, reading);
  EXPECT_TRUE(curve.has_value()) << curve.error().message;
  return curve ? std::move(*curve) : RecordedCurve{std::vector<physics::CurvePoint>(2 * kPoints), {}, {}};
}

std::string refusal(const std::string& file) {
  const auto curve = parse(file);
  return curve ? "accepted" : curve.error().message;
}

constexpr std::size_t kDeepest = kPoints - 1;

TEST(NanosurfCurve, HasApproachAndRetractOfItsLine) {
  const RecordedCurve curve = read(nanosurf_file(usual(), kSpring), 3);
  ASSERT_EQ(curve.points.size(), 2U * kPoints);
  EXPECT_NEAR(curve.points[kDeepest].force.si, force_at(3, kPoints - 1) * kForceStep_n, 1e-18);
  EXPECT_NEAR(curve.points[kDeepest].z.si, height_at(3, kPoints - 1) * kHeightStep_m, 1e-15);
  EXPECT_EQ(curve.points[kDeepest + 1].branch, physics::Branch::Retract);
  EXPECT_NEAR(curve.points.back().z.si, height_at(3, 0) * kHeightStep_m, 1e-15);
  EXPECT_DOUBLE_EQ(curve.metadata.spring_constant->si, 0.2);
  EXPECT_EQ(curve.metadata.instrument, "EZ2-AFM");
  EXPECT_FALSE(curve.metadata.pixel);
}

TEST(NanosurfCurve, TakesTheSensorOfTheHeightBeforeTheScanner) {
  auto channels = usual();
  const auto sensed = [](int curve, int point) { return 2 * height_at(curve, point); };
  channels.push_back(channel("Spec forward", "Z-Axis Sensor", "m", sensed));
  channels.push_back(channel("Spec backward", "Z-Axis Sensor", "m", sensed));
  EXPECT_NEAR(read(nanosurf_file(channels, kSpring)).points[0].z.si, 2 * height_at(0, 0) * kHeightStep_m, 1e-15);
}

TEST(NanosurfCurve, MayBeInMetresOrVolts) {
  const double steps = force_at(0, kPoints - 1);
  const auto metres = nanosurf_file(usual("m"), kSpring);
  EXPECT_NEAR(read(metres).points[kDeepest].force.si, steps * kHeightStep_m * 0.2, 1e-18);
  const auto volts = nanosurf_file(usual("V"), std::string(kSpring) + kHead);
  EXPECT_NEAR(read(volts).points[kDeepest].force.si, steps * kForceStep_n * 0.2 * 1.5e-7, 1e-27);
  EXPECT_DOUBLE_EQ(*read(volts).metadata.sensitivity_m_per_v, 1.5e-7);
  EXPECT_THAT(refusal(nanosurf_file(usual("V"))), HasSubstr("give --spring-constant and --sensitivity"));
  const CurveReading given{.spring_constant = physics::Stiffness(0.4), .sensitivity_m_per_v = 3e-7};
  EXPECT_NEAR(read(nanosurf_file(usual("V")), 0, given).points[kDeepest].force.si, steps * kForceStep_n * 0.4 * 3e-7,
              1e-27);
  EXPECT_NEAR(read(metres, 0, {.spring_constant = physics::Stiffness(0.4), .sensitivity_m_per_v = {}})
                  .points[kDeepest]
                  .force.si,
              steps * kHeightStep_m * 0.4, 1e-18);
}

TEST(NanosurfCurve, EndsWithTheLastRecordedPoint) {
  auto channels = usual();
  for (NanosurfChannel& each : channels) each.save += "LineDim1Points=18\r\n";
  const std::string file = nanosurf_file(channels, kSpring);
  EXPECT_EQ(read(file, 0).points.size(), 2U * kPoints);
  EXPECT_EQ(read(file, 1).points.size(), 2U * 18U);
  EXPECT_NEAR(read(file, 1).points[17].force.si, force_at(1, 17) * kForceStep_n, 1e-18);
}

TEST(NanosurfCurve, OfACutFileIsReadIfItIsWhole) {
  const std::string whole = nanosurf_file(usual(), kSpring);
  constexpr std::size_t kLine = kPoints * sizeof(std::int16_t), kChannel = kLine * kCurves;
  for (std::size_t missing = 1; missing < 4 * kChannel; missing += 7) {
    const std::string cut = whole.substr(0, whole.size() - missing);
    const std::size_t there = missing > kChannel ? 0 : (kChannel - missing) / kLine;
    const std::string said = fmt::format(
        "it is cut short: it has {} of its {} curves; copy the file again from where it was saved", there, kCurves);
    for (const std::size_t index : {std::size_t{0}, there}) {
      const auto curve = parse(cut, index);
      ASSERT_EQ(curve.has_value(), index < there) << missing;
      if (curve) {
        EXPECT_EQ(curve->points.size(), 2U * kPoints);
        EXPECT_THAT(curve->metadata.remarks, Contains(said));
      } else {
        EXPECT_THAT(curve.error().message, HasSubstr(said));
      }
    }
  }
}

TEST(NanosurfCurve, WithDecimalCommasIsRefused) {
  auto channels = usual();
  channels[0].range = "1,25e-6";
  EXPECT_THAT(refusal(nanosurf_file(channels, kSpring)),
              HasSubstr("its \"Dim2Range\" is \"1,25e-6\", with a decimal comma; write a decimal point"));
  EXPECT_THAT(refusal(nanosurf_file(usual(), "\r\n[DataSet\\Calibration\\Cantilever]\r\nProp0=D[0,2]*[N/m]\r\n")),
              HasSubstr("its spring constant is \"0,2\", with a decimal comma"));
}

TEST(NanosurfCurve, SaysThatTheTipRested) {
  auto channels = usual();
  channels.push_back(channel("Spec fwd pause", "Deflection", "N", force_at));
  EXPECT_THAT(read(nanosurf_file(channels, kSpring)).metadata.remarks,
              Contains(HasSubstr("between approach and retract the tip rests: 20 points there are left out")));
}

TEST(NanosurfMap, IsRecordedThereAndBackFromTheBottomLeft) {
  const std::string file = nanosurf_file(usual(), std::string(kSpring) + kMap);
  const std::size_t columns[]{0, 1, 2, 2, 1, 0};
  for (std::size_t index = 0; index < kCurves; ++index) {
    const CurveMetadata data = read(file, index).metadata;
    ASSERT_TRUE(data.pixel) << index;
    EXPECT_EQ(data.pixel->column, columns[index]);
    EXPECT_EQ(data.pixel->row, index / 3);
    EXPECT_NEAR(data.position->x_m, -1e-6 + 1e-6 * static_cast<double>(columns[index]), 1e-15);
    EXPECT_NEAR(data.position->y_m, 2e-6 + 1e-6 * static_cast<double>(index / 3), 1e-15);
    EXPECT_NEAR(data.pixel->grid.width_m, 3e-6, 1e-15);
    EXPECT_NEAR(data.pixel->grid.height_m, 2e-6, 1e-15);
  }
  const support::ScratchFolder folder;
  const auto map = CurveMap::load(folder.write("gel.nid", file), [](std::size_t, std::size_t) { return true; });
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->pixels_with_curve(), 6U);
  EXPECT_NEAR(map->heights_m()[0] - map->heights_m()[3], 5 * kHeightStep_m, 1e-15) << "curves 5 and 0";
}

TEST(NanosurfMap, MayBeginAtAnotherCorner) {
  const auto pixel_of = [](const std::string& map, std::size_t index) {
    const std::string more = std::string(kSpring) + "\r\n[DataSet\\SpecInfos\\SpecMapTable]\r\nMap0=" + map + "\r\n";
    return read(nanosurf_file(usual(), more), index).metadata;
  };
  const auto from_right = pixel_of("1e-6;-1e-6;3e-6;2e-6;3;2;0;1", 3).pixel;
  ASSERT_TRUE(from_right);
  EXPECT_EQ(from_right->column, 0U);
  EXPECT_EQ(from_right->row, 0U);
  EXPECT_FALSE(pixel_of("-1e-6;1e-6;2e-6;3e-6;3;2;30;1", 3).position) << "a map that is turned";
  EXPECT_EQ(pixel_of("-1e-6;1e-6;2e-6;3e-6;3;4;0;1", 5).pixel->row, 1U) << "a map that was stopped";
  for (const char* none : {"", "-1e-6;1e-6", "0;0;0;0;3;2;0;1", "-1e-6;1e-6;2e-6;3e-6;2;2;0;1", "a;b;c;d;3;2;0;1",
                           "0;1e9;0;1e9;3;2;0;1", "0;1e-6;0;1e-6;1e9;2;0;1", "0;1e-6;0;1e-6;-3;2;0;1"}) {
    EXPECT_FALSE(pixel_of(none, 0).pixel) << none;
  }
}

TEST(NanosurfCurve, IsACurveAndBesideAScanAnImageToo) {
  const support::ScratchFolder folder;
  const std::string alone = folder.write("alone.nid", nanosurf_file(usual(), kSpring));
  EXPECT_TRUE(is_curve_file(alone));
  EXPECT_FALSE(is_image_file(alone));
  auto channels = usual();
  channels.insert(channels.begin(), NanosurfChannel{});
  const std::string both = folder.write("both.nid", nanosurf_file(channels, kSpring));
  EXPECT_TRUE(is_image_file(both));
  EXPECT_EQ(load_image(both)->image.channels.size(), 1U);
  EXPECT_EQ(curve_count(both).value(), 6U);
  EXPECT_TRUE(load_curve(both));
}

TEST(NanosurfCurve, SurvivesAnyChangeOfItsHeader) {
  const std::string file = nanosurf_file(usual("V"), std::string(kSpring) + kHead + kMap);
  EXPECT_GT(test::read_after_damage(file, file.find("#!"), kCurves - 1), 1000);
}

TEST(NanosurfCurve, IsRefusedInOneLineIfItIsNotUnderstood) {
  const auto changed = [](const auto& change) {
    auto channels = usual();
    change(channels);
    return refusal(nanosurf_file(channels, kSpring));
  };
  EXPECT_THAT(changed([](auto& c) { c[0].name = "Current"; }), HasSubstr("it is no force curve"));
  EXPECT_THAT(changed([](auto& c) { c[1].unit = "V"; }), HasSubstr("its height is in \"V\""));
  EXPECT_THAT(changed([](auto& c) { c[0].unit = "deg"; }), HasSubstr("its deflection is in \"deg\""));
  EXPECT_THAT(changed([](auto& c) { c[2].unit = "m"; }), HasSubstr("in different units"));
  EXPECT_THAT(changed([](auto& c) { c[2].rows = 5; }), HasSubstr("differ in their number of curves"));
  EXPECT_THAT(changed([](auto& c) { c[1].columns = 10; }), HasSubstr("differ in length"));
  EXPECT_THAT(changed([](auto& c) { c[0].save += "LineDim0Points=21\r\n"; }), HasSubstr("21 of its 20 points"));
  EXPECT_THAT(changed([](auto& c) { c[0].rows = 0; }), HasSubstr("cannot read the curve a.nid: "));
  EXPECT_THAT(refusal(nanosurf_file(usual("V"), kHead)), HasSubstr("give --spring-constant"));
  const std::string whole = nanosurf_file(usual(), kSpring);
  for (std::size_t size = 0; size < whole.size(); size += size < 3000 ? 1 : 7) {
    EXPECT_FALSE(parse(whole.substr(0, size), kCurves - 1)) << size;
  }
}

}  // namespace nanosurf_curves_test
}  // namespace afm::curves
