// SPDX-License-Identifier: Apache-2.0
// Force volumes of Bruker's Nanoscope, from files that are put together here as published readers describe them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "curves/curve_file.h"
#include "curves/curve_map.h"
#include "curves/curve_series.h"
#include "damaged_curves.h"
#include "support/image_files.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace nanoscope_volumes_test {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t kColumns = 3, kRows = 2, kCurves = kColumns * kRows, kPoints = 20;
constexpr double kLsb_v = 24.576 / 65536, kNewtonPerV = 60e-9 * 0.32, kRamp_m = 50.0 * 12.5e-9;
constexpr double kHeightStep_m = 12.5e-9 * 440.0 / 65536;  // one integer of the image

struct Volume {
  int bytes = 2;  // size of an integer
  std::string version = "0x08150300", per_line = "\\force/line: 3\r\n", scan, sensor_scale;
  std::size_t image_columns = kColumns, image_rows = kRows;
  std::string image_size = "3 2 ~m";
  std::function<int(std::size_t column, std::size_t row)> height = [](std::size_t column, std::size_t row) {
    return static_cast<int>(100 * row + 10 * column);
  };
  std::size_t curves = kCurves;
  bool swings = false;  // true: deflection that counts the time in a period
  std::string sensor_name = "Height Sensor";
  int sensed = 0;  // 1, -1: both channels swing, with this sign of the sensor
};

// Time of a point, in an order in which each branch is stored from the sample outwards or back.
std::size_t time_of(int branch, std::size_t point) { return branch == 0 ? kPoints - 1 - point : kPoints + point; }

// A swing of 1000 integers about 0, lowest 11.75 points after the beginning of a period.
constexpr double kTurn = 11.75;
int swing_at(std::size_t time) {
  return static_cast<int>(std::lround(-1000.0 * std::cos(2.0 * M_PI * (static_cast<double>(time) - kTurn) / 40.0)));
}

// Header of a capture whose deepest point is 11.75 of 40 points after the beginning of a period.
Volume capture() {
  Volume volume;
  volume.scan =
      "\\PeakForce Capture: Allow\r\n\\Sync Distance: 1\r\n\\Sync Distance QNM: 23.5\r\n\\Sample Points: "
      "80\r\n\\Peak Force Amplitude: 150\r\n";
  volume.swings = true;
  return volume;
}

void put_integer(std::string& data, int integer, int bytes) {
  if (bytes == 2) test::append_little(data, static_cast<std::int16_t>(integer));
  if (bytes == 4) test::append_little(data, static_cast<std::int32_t>(integer));
}

// Pushes over the five deepest points of each branch, harder from curve to curve.
int deflection_at(std::size_t curve, std::size_t point) {
  return point < 5 ? static_cast<int>((curve + 1) * 100 * (5 - point)) : 0;
}

std::string file_of(const Volume& volume) {
  constexpr std::size_t kFirst = 4096;
  std::string header =
      "\\*Force file list\r\n\\Version: " + volume.version +
      "\r\n\\Start context: FVOL\r\n\\*Scanner list\r\n\\@Sens. Zsens: V 12.5 nm/V\r\n\\*Ciao scan list\r\n"
      "\\Scan Size: 3000 nm\r\n\\X Offset: 500 nm\r\n\\Y Offset: -1 ~m\r\n\\@Sens. ZsensSens: V 100.0 nm/V\r\n"
      "\\@Sens. DeflSens: V 60.0 nm/V\r\n" +
      volume.scan + "\\*Ciao force list\r\n" + volume.per_line;
  std::string data;
  const auto add_channel = [&](const std::string& name, const std::string& scale, const auto& integer_at) {
    const std::size_t offset = kFirst + data.size();
    for (std::size_t curve = 0; curve < volume.curves; ++curve) {
      for (int branch = 0; branch < 2; ++branch) {
        for (std::size_t point = 0; point < kPoints; ++point) {
          put_integer(data, integer_at(curve, branch, point), volume.bytes);
        }
      }
    }
    header += fmt::format(
        "\\*Ciao force image list\r\n\\Data offset: {}\r\n\\Data length: {}\r\n\\Bytes/pixel: 2\r\n\\Samps/line: {} "
        "{}\r\n\\Spring Constant: 0.32\r\n\\@4:Image Data: S [Channel] \"{}\"\r\n\\@4:Z scale: {}\r\n"
        "\\@4:Ramp size: V [Sens. Zsens] (0.0067 V/LSB) 50.0 V\r\n",
        offset, kFirst + data.size() - offset, kPoints, kPoints, name, scale);
  };
  add_channel("Deflection Error", "V [Sens. DeflSens] (0.0003750 V/LSB) 24.576 V",
              [&](std::size_t curve, int branch, std::size_t point) {
                const std::size_t time = time_of(branch, point);
                if (volume.sensed != 0) return 2000 - swing_at(time);
                if (!volume.swings) return deflection_at(curve, point);
                return static_cast<int>(1000 * (curve + 1) + 10 * time);
              });
  if (!volume.sensor_scale.empty()) {
    add_channel(volume.sensor_name, volume.sensor_scale, [&](std::size_t curve, int branch, std::size_t point) {
      if (volume.sensed != 0) return volume.sensed * swing_at(time_of(branch, point));
      return static_cast<int>(1000 * (curve + 1) + 30 * point);
    });
  }
  header += fmt::format(
      "\\*Ciao image list\r\n\\Data offset: {}\r\n\\Data length: {}\r\n\\Bytes/pixel: 2\r\n\\Samps/line: "
      "{}\r\n\\Number "
      "of lines: {}\r\n\\Scan Size: {}\r\n\\@2:Image Data: S [Height] \"Height\"\r\n\\@2:Z scale: V [Sens. Zsens] "
      "(0.0067 V/LSB) 440.0 V\r\n\\*File list end\r\n\x1a",
      kFirst + data.size(), volume.image_columns * volume.image_rows * static_cast<std::size_t>(volume.bytes),
      volume.image_columns, volume.image_rows, volume.image_size);
  for (std::size_t row = 0; row < volume.image_rows; ++row) {
    for (std::size_t column = 0; column < volume.image_columns; ++column) {
      put_integer(data, volume.height(column, row), volume.bytes);
    }
  }
  header.resize(kFirst, '\0');
  return header + data;
}

RecordedCurve read(const Volume& volume, std::size_t index) {
  auto curve = parse_curve(file_of(volume), "a.spm",
                           {.spring_constant = {}, .sensitivity_m_per_v = {}, .index = index, .confined = false});
  EXPECT_TRUE(curve.has_value()) << curve.error().message;
  return curve ? std::move(*curve) : RecordedCurve{std::vector<physics::CurvePoint>(2 * kPoints), {}, {}};
}

std::string refusal(const Volume& volume) {
  const auto curve = parse_curve(file_of(volume), "a.spm");
  return curve ? "accepted" : curve.error().message;
}

double lowest_z_m(const RecordedCurve& curve) { return curve.points[kPoints - 1].z.si; }

TEST(NanoscopeVolume, HasACurveForEachPixelFromTheBottomLeft) {
  for (std::size_t index = 0; index < kCurves; ++index) {
    const RecordedCurve curve = read({}, index);
    ASSERT_EQ(curve.points.size(), 2 * kPoints);
    const double step_n = kLsb_v * kNewtonPerV * 100 * static_cast<double>(index + 1);
    EXPECT_NEAR(curve.points[kPoints - 1].force.si, 5 * step_n, 1e-6 * step_n);
    EXPECT_NEAR(curve.points[kPoints + 1].force.si, 4 * step_n, 1e-6 * step_n);
    EXPECT_NEAR(curve.points[0].z.si - lowest_z_m(curve), kRamp_m * (kPoints - 1) / kPoints, 1e-15);
    const auto& pixel = curve.metadata.pixel;
    ASSERT_TRUE(pixel);
    EXPECT_EQ(pixel->column, index % kColumns);
    EXPECT_EQ(pixel->row, index / kColumns);
    EXPECT_EQ(pixel->grid.columns, kColumns);
    EXPECT_EQ(pixel->grid.rows, kRows);
    EXPECT_NEAR(pixel->grid.width_m, 3e-6, 1e-15);
    EXPECT_NEAR(pixel->grid.height_m, 2e-6, 1e-15);
    EXPECT_NEAR(curve.metadata.position->x_m, (-0.5 + static_cast<double>(pixel->column)) * 1e-6, 1e-15);
    EXPECT_NEAR(curve.metadata.position->y_m, (-1.5 + static_cast<double>(pixel->row)) * 1e-6, 1e-15);
    EXPECT_NEAR(lowest_z_m(curve), kHeightStep_m * static_cast<double>(100 * pixel->row + 10 * pixel->column), 1e-15);
  }
  EXPECT_THAT(read({}, 4).metadata.remarks, ElementsAre("it is curve 4 of 6, counted from 0"));
}

TEST(NanoscopeVolume, IsAForceMap) {
  const support::ScratchFolder folder;
  const std::string path = folder.write("gel.spm", file_of({}));
  ASSERT_EQ(curve_count(path).value(), kCurves);
  const auto map = CurveMap::load(path, [](std::size_t, std::size_t) { return true; });
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->pixels_with_curve(), kCurves);
  const std::vector<double> steps{100, 110, 120, 0, 10, 20};  // rows from the top
  for (std::size_t i = 0; i < kCurves; ++i) EXPECT_NEAR(map->heights_m()[i], kHeightStep_m * steps[i], 1e-15) << i;
}

// A period of PeakForce tapping begins with the approach, half a period before its deepest point.
TEST(NanoscopeVolume, OfPeakForceTappingIsTurnedToItsDeepestPoint) {
  constexpr double kAmplitude_m = 150e-9;
  for (const std::size_t index : {0U, 5U}) {
    const RecordedCurve curve = read(capture(), index);
    ASSERT_EQ(curve.points.size(), 2 * kPoints);
    const double lowest_m = kHeightStep_m * static_cast<double>(100 * (index / kColumns) + 10 * (index % kColumns));
    for (std::size_t i = 0; i < 2 * kPoints; ++i) {
      const std::size_t time = (32 + i) % (2 * kPoints);  // 8 points before the beginning: 11.75 - 20 = -8.25
      const double turns = (static_cast<double>(i) - 8.0 - kTurn) / (2.0 * kPoints);
      EXPECT_NEAR(curve.points[i].z.si, lowest_m + kAmplitude_m * (1.0 - std::cos(2.0 * M_PI * turns)), 1e-15) << i;
      EXPECT_NEAR(curve.points[i].force.si, kLsb_v * kNewtonPerV * static_cast<double>(1000 * (index + 1) + 10 * time),
                  1e-20)
          << i;
      EXPECT_EQ(curve.points[i].branch, i < kPoints ? physics::Branch::Approach : physics::Branch::Retract);
    }
    EXPECT_THAT(
        curve.metadata.remarks,
        testing::Contains(HasSubstr("a period of PeakForce tapping: its heights are those of a swing of 150 nm")));
  }
}

TEST(NanoscopeVolume, OfPeakForceTappingHasTheOlderSyncDistanceWithoutThatOfQnm) {
  Volume older = capture();
  older.scan.replace(older.scan.find("\\Sync Distance QNM: 23.5"), 24, "\\Sync Distance New: 23.5");
  const RecordedCurve curve = read(older, 0);
  EXPECT_NEAR(curve.points[kPoints - 1].force.si, kLsb_v * kNewtonPerV * 1000.0, 1e-20) << "half a point after 0";
}

TEST(NanoscopeVolume, OfPeakForceTappingIsRefusedIfItsSwingIsUnknown) {
  for (const auto& [key, text] :
       {std::pair("\\Sync Distance QNM: 23.5", "\\Sync Distance QNM: many"),
        std::pair("\\Sync Distance QNM: 23.5", "\\Sync Distance QNM: -5"),
        std::pair("\\Sample Points: 80", "\\Sample Points: 0"), std::pair("\\Sample Points: 80", "\\Simple Points: 80"),
        std::pair("\\Peak Force Amplitude: 150", "\\Peak Force Amplitude: 150 mm"),
        std::pair("\\Peak Force Amplitude: 150", "\\Peak Force Amplitude: 150 V"),
        std::pair("\\Peak Force Amplitude: 150", "\\Peak Force Amplitude: nan")}) {
    Volume wrong = capture();
    wrong.scan.replace(wrong.scan.find(key), std::string(key).size(), text);
    EXPECT_THAT(refusal(wrong), HasSubstr("PeakForce capture")) << text;
  }
}

// The header need not describe the swing of a capture with a channel of its height, whose sensor counts either way.
TEST(NanoscopeVolume, OfPeakForceTappingHasTheHeightsOfItsChannel) {
  constexpr double kSensor_m = 1e-4 * 100e-9;  // height of an integer
  for (const char* name : {"Height Sensor", "Height"}) {
    for (const int sign : {1, -1}) {
      Volume sensed;
      sensed.scan = "\\PeakForce Capture: Allow\r\n";
      sensed.sensor_scale = "V [Sens. ZsensSens] (0.0001 V/LSB) 6.5536 V";
      sensed.sensor_name = name;
      sensed.sensed = sign;
      const RecordedCurve curve = read(sensed, 5);
      ASSERT_EQ(curve.points.size(), 2 * kPoints);
      for (std::size_t i = 0; i < 2 * kPoints; ++i) {
        const int swing = swing_at((32 + i) % (2 * kPoints));  // half a period before the deepest point
        EXPECT_NEAR(curve.points[i].z.si, kSensor_m * swing, 1e-16) << name << sign << ", " << i;
        EXPECT_NEAR(curve.points[i].force.si, kLsb_v * kNewtonPerV * (2000 - swing), 1e-20) << name << sign << i;
        EXPECT_EQ(curve.points[i].branch, i < kPoints ? physics::Branch::Approach : physics::Branch::Retract);
      }
      EXPECT_THAT(curve.metadata.remarks, testing::Contains(HasSubstr("PeakForce tapping with recorded heights")));
    }
  }
}

// A fast force volume says that it is a capture, too, and begins where its approach does.
TEST(NanoscopeVolume, OfPeakForceTappingThatBeginsWithItsApproachIsNotTurned) {
  Volume ramps;
  ramps.scan = "\\PeakForce Capture: Allow\r\n";
  ramps.sensor_scale = "V [Sens. ZsensSens] (0.0001 V/LSB) 6.5536 V";
  const RecordedCurve sensed = read(ramps, 5);
  ramps.scan.clear();
  const RecordedCurve usual = read(ramps, 5);
  ASSERT_EQ(sensed.points.size(), usual.points.size());
  for (std::size_t i = 0; i < usual.points.size(); ++i) {
    EXPECT_EQ(sensed.points[i].z, usual.points[i].z) << i;
    EXPECT_EQ(sensed.points[i].force, usual.points[i].force) << i;
  }
}

// Files from version 9.2 on, in which integers of two bytes take four.
TEST(NanoscopeVolume, MayHaveTwoBytesInFour) {
  Volume wide;
  wide.bytes = 4;
  wide.version = "0x09200000";
  for (const std::size_t index : {0U, 5U}) {
    const RecordedCurve two = read({}, index), four = read(wide, index);
    EXPECT_EQ(lowest_z_m(four), lowest_z_m(two));
    EXPECT_NEAR(four.points[kPoints - 1].force.si, two.points[kPoints - 1].force.si, 1e-4 * two.points[19].force.si);
  }
}

// Damage by an editor that removed or added a character of the header.
TEST(NanoscopeVolume, IsRefusedIfItsDataHaveMoved) {
  Volume wide;
  wide.bytes = 4;
  wide.version = "0x09200000";
  std::string file = file_of(wide);
  file.erase(file.size() - 1);
  file.insert(4000, 1, '\0');
  const auto curve = parse_curve(file, "a.spm");
  ASSERT_FALSE(curve);
  EXPECT_THAT(curve.error().message, HasSubstr("more than the two bytes that its header states"));
}

TEST(NanoscopeVolume, MayHaveSeveralPointsOfTheImageForACurve) {
  Volume fine;
  fine.image_columns = 2 * kColumns;
  fine.image_rows = 2 * kRows;
  EXPECT_NEAR(lowest_z_m(read(fine, 5)), kHeightStep_m * (100 * 2 + 10 * 4), 1e-15);
  EXPECT_EQ(read(fine, 5).metadata.pixel->row, 1U);
}

TEST(NanoscopeVolume, HasTheHeightsOfItsSensor) {
  Volume sensed;
  sensed.sensor_scale = "V [Sens. ZsensSens] (0.0001 V/LSB) 6.5536 V";
  for (const std::size_t index : {0U, 5U}) {
    const RecordedCurve curve = read(sensed, index);
    EXPECT_NEAR(lowest_z_m(curve), static_cast<double>(1000 * (index + 1)) * 1e-4 * 100e-9, 1e-15);
    EXPECT_GT(curve.points[0].z.si, lowest_z_m(curve));
  }
}

TEST(NanoscopeVolume, HasNoPositionsIfItsScanIsTurned) {
  Volume turned;
  turned.scan = "\\Rotate Ang.: 90\r\n";
  EXPECT_FALSE(read(turned, 1).metadata.position);
  EXPECT_EQ(read(turned, 1).metadata.pixel->column, 1U);
}

TEST(NanoscopeVolume, IsReadWithoutItsImage) {
  Volume bare;
  bare.image_size = "3 2 V";
  const RecordedCurve curve = read(bare, 5);
  EXPECT_FALSE(curve.metadata.pixel);
  EXPECT_THAT(curve.metadata.remarks,
              testing::Contains(HasSubstr("its image Height cannot be read, so that the grid")));
  bare.per_line = "";
  bare.image_columns = 0;
  EXPECT_EQ(read(bare, 5).points.size(), 2 * kPoints);
}

TEST(NanoscopeVolume, IsRefusedInOneLineIfItsCurvesAreNotUnderstood) {
  Volume stopped;
  stopped.curves = 4;
  EXPECT_THAT(refusal(stopped), HasSubstr("320 bytes, which are not 3 x 2 curves of two branches of 20 points"));
  for (const char* wrong :
       {"\\force/line: 0\r\n", "\\force/line: nan\r\n", "\\force/line: 1e30\r\n", "\\force/line: 2\r\n"}) {
    Volume damaged;
    damaged.per_line = wrong;
    EXPECT_THAT(refusal(damaged), HasSubstr("cannot read the curve a.spm: its")) << wrong;
  }
}

TEST(NanoscopeVolume, SurvivesAnyChangeOfItsHeader) {
  Volume sensed;
  sensed.sensor_scale = "V [Sens. ZsensSens] (0.0001 V/LSB) 6.5536 V";
  Volume sensed_capture = sensed;
  sensed_capture.scan = "\\PeakForce Capture: Allow\r\n";
  for (const Volume& volume : {Volume(), sensed, sensed_capture, capture()}) {
    const std::string file = file_of(volume);
    EXPECT_GT(test::read_after_damage(file, file.find('\x1a'), kCurves - 1), 1000);
  }
}

core::Result<RecordedCurve> read_cut(const std::string& whole, std::size_t size, std::size_t index) {
  return parse_curve(std::string_view(whole).substr(0, size), "cut.spm",
                     {.spring_constant = {}, .sensitivity_m_per_v = {}, .index = index, .confined = false});
}

constexpr const char* kCopyIt = "; copy the file again from where it was saved";

TEST(NanoscopeVolume, CutInItsHeaderIsRefused) {
  const std::string whole = file_of({});
  for (std::size_t size = 40; size < whole.find("\\*File list end"); ++size) {
    const auto cut = read_cut(whole, size, 0);
    ASSERT_FALSE(cut.has_value()) << size;
    EXPECT_THAT(cut.error().message, AllOf(HasSubstr("it is cut short"), HasSubstr(kCopyIt)));
  }
}

// The image lies behind all curves, one of two channels behind the other.
TEST(NanoscopeVolume, ThatIsCutHasItsFirstCurves) {
  Volume sensed;
  sensed.sensor_scale = "V [Sens. ZsensSens] (0.0001 V/LSB) 6.5536 V";
  for (const Volume& volume : {Volume(), sensed}) {
    constexpr std::size_t kCurve = 2 * kPoints * sizeof(std::int16_t);
    const std::string whole = file_of(volume);
    const std::size_t first = volume.sensor_scale.empty() ? 4096 : 4096 + kCurves * kCurve;  // data of the last channel
    for (std::size_t size = 4090; size < whole.size(); size += 3) {
      const std::size_t there = size < first ? 0 : std::min(kCurves, (size - first) / kCurve);
      const std::string said = fmt::format("it is cut short: it has {} of its {} curves{}", there, kCurves, kCopyIt);
      for (const std::size_t index : {std::size_t{0}, std::min(there, kCurves - 1)}) {
        const auto cut = read_cut(whole, size, index);
        ASSERT_EQ(cut.has_value(), index < there) << size << ", " << index;
        if (!cut) {
          EXPECT_THAT(cut.error().message, HasSubstr(said));
          continue;
        }
        EXPECT_EQ(cut->points[kPoints - 1].force.si, read(volume, index).points[kPoints - 1].force.si);
        EXPECT_THAT(cut->metadata.remarks,
                    Contains(HasSubstr("the heights of its curves are unknown: it is cut short")));
        if (there < kCurves) {
          EXPECT_THAT(cut->metadata.remarks, Contains(said));
        }
      }
    }
  }
}

TEST(NanoscopeVolume, WithDecimalCommasIsRefused) {
  Volume german;
  german.image_size = "3,5 2,5 ~m";
  EXPECT_THAT(read(german, 0).metadata.remarks, Contains(HasSubstr("is \"3,5 2,5 ~m\", with a decimal comma")));
  german.sensor_scale = "V [Sens. ZsensSens] (0,0001 V/LSB) 6,5536 V";
  EXPECT_THAT(refusal(german),
              HasSubstr("a number of its header is \"0,0001 V/LSB\", with a decimal comma; write a decimal point"));
}

}  // namespace nanoscope_volumes_test
}  // namespace afm::curves
