// SPDX-License-Identifier: Apache-2.0
// Single ramps of Bruker's Nanoscope, from files that are put together here as published readers describe them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "curves/curve_file.h"
#include "support/image_files.h"

namespace afm::curves {
namespace nanoscope_curves_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kPoints = 20;
constexpr double kLsb_v = 24.576 / 65536, kSensitivity = 60e-9, kSpringConstant = 0.32;
constexpr double kRamp_m = 50.0 * 12.5e-9;

struct Channel {
  std::string name = "Deflection Error";
  std::string scale = "V [Sens. DeflSens] (0.0003750 V/LSB) 24.576 V";
  std::vector<int> integers;  // stored order: the extend from the sample outwards, then the retract
};

struct Ramp {
  std::vector<Channel> channels;
  std::string samples = fmt::format("{0} {0}", kPoints);
  std::string sensitivity = "\\@Sens. DeflSens: V 60.0 nm/V\r\n";
  std::string spring = "\\Spring Constant: 0.32\r\n";
  std::string list = "\\@4:Ramp size Zsweep: V [Sens. Zsens] (0.0067 V/LSB) 50.0 V\r\n";
  std::string other;  // text of another block
  int bytes = 2;
};

// Pushes over the five deepest points of each branch, 100 integers a point.
std::vector<int> deflection() {
  std::vector<int> integers;
  for (int branch = 0; branch < 2; ++branch) {
    for (int i = 0; i < kPoints; ++i) integers.push_back(i < 5 ? 100 * (5 - i) : -branch);
  }
  return integers;
}

std::string file_of(const Ramp& ramp) {
  constexpr std::size_t kFirst = 4096;
  std::string header =
      "\\*Force file list\r\n\\Version: 0x08150300\r\n\\Date: 04:42:34 PM Tue Sep 11 2007\r\n"
      "\\*Equipment list\r\n\\Microscope: MultiMode\r\n\\*Scanner list\r\n\\@Sens. Zsens: V 12.5 nm/V\r\n"
      "\\*Ciao scan list\r\n\\@Sens. ZsensSens: V 100.0 nm/V\r\n" +
      ramp.sensitivity + "\\*Ciao force list\r\n" + ramp.list + ramp.other;
  std::string data;
  for (const Channel& channel : ramp.channels) {
    const std::size_t length = channel.integers.size() * static_cast<std::size_t>(ramp.bytes);
    header += fmt::format(
        "\\*Ciao force image list\r\n\\Data offset: {}\r\n\\Data length: {}\r\n\\Bytes/pixel: {}\r\n\\Samps/line: "
        "{}\r\n"
        "{}\\@4:Image Data: S [Channel] \"{}\"\r\n\\@4:Z scale: {}\r\n",
        kFirst + data.size(), length, ramp.bytes, ramp.samples, ramp.spring, channel.name, channel.scale);
    for (const int integer : channel.integers) {
      if (ramp.bytes == 2) test::append_little(data, static_cast<std::int16_t>(integer));
      if (ramp.bytes == 4) test::append_little(data, static_cast<std::int32_t>(integer));
    }
  }
  header += "\\*File list end\r\n\x1a";
  header.resize(kFirst, '\0');
  return header + data;
}

Ramp usual() {
  Ramp ramp;
  ramp.channels.emplace_back().integers = deflection();
  return ramp;
}

RecordedCurve read(const Ramp& ramp, const CurveReading& reading = {}) {
  auto curve = parse_curve(file_of(ramp), "a.spm", reading);
  EXPECT_TRUE(curve.has_value()) << curve.error().message;
  return curve ? std::move(*curve) : RecordedCurve{std::vector<physics::CurvePoint>(2 * kPoints), {}, {}};
}

std::string refusal(const std::string& bytes, const CurveReading& reading = {}) {
  const auto curve = parse_curve(bytes, "a.spm", reading);
  return curve ? "accepted" : curve.error().message;
}

TEST(NanoscopeCurve, HasBothBranchesOfTheLineInTheOrderOfTime) {
  const RecordedCurve curve = read(usual());
  ASSERT_EQ(curve.points.size(), 2U * kPoints);
  const auto &farthest = curve.points[0], &deepest = curve.points[kPoints - 1], &back = curve.points[kPoints];
  EXPECT_EQ(deepest.branch, physics::Branch::Approach);
  EXPECT_EQ(back.branch, physics::Branch::Retract);
  EXPECT_NEAR((farthest.z - deepest.z).si, kRamp_m * (kPoints - 1) / kPoints, 1e-15);
  EXPECT_EQ(back.z, deepest.z);
  EXPECT_EQ(farthest.force.si, 0.0);
  EXPECT_DOUBLE_EQ(deepest.force.si, 500 * kLsb_v * kSensitivity * kSpringConstant);
  EXPECT_DOUBLE_EQ(curve.points.back().force.si, -kLsb_v * kSensitivity * kSpringConstant);
  EXPECT_DOUBLE_EQ(curve.metadata.spring_constant->si, kSpringConstant);
  EXPECT_DOUBLE_EQ(*curve.metadata.sensitivity_m_per_v, kSensitivity);
  EXPECT_EQ(curve.metadata.date, "2007-09-11");
  EXPECT_EQ(curve.metadata.time, "16:42:34");
  EXPECT_EQ(curve.metadata.instrument, "MultiMode");
  EXPECT_THAT(curve.metadata.remarks, IsEmpty());
}

TEST(NanoscopeCurve, MayHaveIntegersOfFourBytes) {
  Ramp ramp = usual();
  ramp.bytes = 4;
  for (int& integer : ramp.channels[0].integers) integer *= 65536;
  ramp.channels[0].scale = "V [Sens. DeflSens] (0.00000000572 V/LSB) 24.576 V";
  EXPECT_DOUBLE_EQ(read(ramp).points[kPoints - 1].force.si, 500 * kLsb_v * kSensitivity * kSpringConstant);
}

// In older files the range after the bracket is that of the screen.
TEST(NanoscopeCurve, BelievesTheScaleOfAnInteger) {
  Ramp ramp = usual();
  ramp.channels[0].scale = "V [Sens. DeflSens] (0.0005 V/LSB) 12.5 V";
  EXPECT_DOUBLE_EQ(read(ramp).points[kPoints - 1].force.si, 500 * 0.0005 * kSensitivity * kSpringConstant);
}

TEST(NanoscopeCurve, TakesTheHeightOfItsSensorWhicheverWayItCounts) {
  for (const int way : {1, -1}) {
    Ramp ramp = usual();
    std::vector<int> sensor;
    for (int i = 0; i < 2 * kPoints; ++i) sensor.push_back(way * 300 * (i % kPoints));
    ramp.channels.push_back({"Height Sensor", "V [Sens. ZsensSens] (0.0001 V/LSB) 6.5536 V", sensor});
    const RecordedCurve curve = read(ramp);
    EXPECT_NEAR((curve.points[0].z - curve.points[kPoints - 1].z).si, 300 * (kPoints - 1) * 1e-4 * 100e-9, 1e-15);
    EXPECT_EQ(curve.points[kPoints].z, curve.points[kPoints - 1].z);
  }
}

TEST(NanoscopeCurve, LeavesOutWhatWasNotRecorded) {
  Ramp ramp = usual();
  for (const int i : {17, 18, 19}) {
    ramp.channels[0].integers[static_cast<std::size_t>(i)] = std::numeric_limits<std::int16_t>::min();
  }
  const RecordedCurve curve = read(ramp);
  EXPECT_EQ(curve.points.size(), 2U * kPoints - 3U);
  EXPECT_THAT(curve.metadata.remarks, ElementsAre(HasSubstr("3 of its 40 points were not recorded")));
  // the second number of points is that of the extend
  ramp.samples = fmt::format("{} {}", kPoints, kPoints - 3);
  const RecordedCurve shorter = read(ramp);
  EXPECT_EQ(shorter.points.size(), 2U * kPoints - 3U);
  EXPECT_EQ(shorter.points[0].z, curve.points[0].z);
  EXPECT_THAT(shorter.metadata.remarks, IsEmpty());
}

TEST(NanoscopeCurve, SaysThatTheTipRested) {
  Ramp ramp = usual();
  ramp.list += "\\Reverse delay: 2.5\r\n";
  EXPECT_THAT(read(ramp).metadata.remarks,
              ElementsAre(HasSubstr("between approach and retract the tip rests for 2.5 s")));
}

// The hold follows both branches, in each channel or in none.
TEST(NanoscopeCurve, LeavesOutAHold) {
  constexpr int kHold = 7;
  for (const int bytes : {2, 4}) {
    Ramp ramp = usual();
    ramp.bytes = bytes;
    const RecordedCurve expected = read(ramp);
    ramp.list += fmt::format("\\Hold Samples: {}\r\n\\Hold Time: 5\r\n", kHold);
    ramp.channels.push_back({"Height Sensor", "V [Sens. ZsensSens] (0.0001 V/LSB) 6.5536 V", {}});
    for (int i = 0; i < 2 * kPoints; ++i) ramp.channels[1].integers.push_back(300 * (i % kPoints));
    const RecordedCurve without = read(ramp);
    EXPECT_THAT(without.metadata.remarks, IsEmpty());
    for (Channel& channel : ramp.channels) channel.integers.insert(channel.integers.end(), kHold, 777);
    const RecordedCurve curve = read(ramp);
    ASSERT_EQ(curve.points.size(), expected.points.size());
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      EXPECT_EQ(curve.points[i].force, expected.points[i].force) << i;
      EXPECT_EQ(curve.points[i].z, without.points[i].z) << i;
    }
    EXPECT_THAT(curve.metadata.remarks,
                ElementsAre("between approach and retract the tip rests for 5 s: 7 points there are left out"));
  }
}

// A hold as long as both branches: the version of the file gives the size of its integers.
TEST(NanoscopeCurve, MayHaveAHoldAsLongAsItsBranches) {
  Ramp ramp = usual();
  const RecordedCurve expected = read(ramp);
  ramp.list += fmt::format("\\Hold Samples: {}\r\n", 2 * kPoints);
  ramp.channels[0].integers.insert(ramp.channels[0].integers.end(), 2 * kPoints, 777);
  const RecordedCurve curve = read(ramp);
  ASSERT_EQ(curve.points.size(), expected.points.size());
  EXPECT_EQ(curve.points[kPoints - 1].force, expected.points[kPoints - 1].force);
  EXPECT_EQ(curve.points.back().force, expected.points.back().force);
}

TEST(NanoscopeCurve, TakesACalibrationThatItDoesNotHold) {
  Ramp ramp = usual();
  ramp.sensitivity.clear();
  EXPECT_THAT(refusal(file_of(ramp)), HasSubstr("its lever is not calibrated; give --sensitivity"));
  ramp.spring.clear();
  EXPECT_THAT(refusal(file_of(ramp)), HasSubstr("give --spring-constant and --sensitivity"));
  const CurveReading reading{.spring_constant = physics::Stiffness(0.1), .sensitivity_m_per_v = 50e-9};
  EXPECT_DOUBLE_EQ(read(ramp, reading).points[kPoints - 1].force.si, 500 * kLsb_v * 50e-9 * 0.1);
  EXPECT_DOUBLE_EQ(read(usual(), reading).points[kPoints - 1].force.si, 500 * kLsb_v * 50e-9 * 0.1);
}

TEST(NanoscopeCurve, NamesASensitivityWithoutAUnit) {
  Ramp ramp = usual();
  ramp.sensitivity = "\\@Sens. DeflSens: V 27.39000 \r\n";
  EXPECT_THAT(refusal(file_of(ramp)), HasSubstr("give --sensitivity (its \"Sens. DeflSens\" of 27.39 has no unit)"));
}

TEST(NanoscopeCurve, IsNoVolumeForTheImageThatItsPlaceWasChosenIn) {
  Ramp ramp = usual();
  ramp.other = "\\force/line: 16\r\n\\*Ciao image list\r\n\\Samps/line: 64\r\n\\Number of lines: 64\r\n";
  EXPECT_FALSE(read(ramp).metadata.pixel);
}

TEST(NanoscopeCurve, RefusesWhatItDoesNotUnderstand) {
  const auto changed = [](const auto& change) {
    Ramp ramp = usual();
    change(ramp);
    return refusal(file_of(ramp));
  };
  EXPECT_THAT(changed([](Ramp& r) { r.channels[0].integers.resize(60); }), HasSubstr("120 bytes, which are not two"));
  for (const char* hold : {"21", "-1", "2.5", "nan", "1e12", "many"}) {
    EXPECT_THAT(changed([&](Ramp& r) {
                  r.list += fmt::format("\\Hold Samples: {}\r\n", hold);
                  r.channels[0].integers.resize(2 * kPoints + 20);
                }),
                HasSubstr("cannot read the curve a.spm: it"))
        << hold;
  }
  EXPECT_THAT(changed([](Ramp& r) { r.channels[0].scale = "C none"; }), HasSubstr("no \"@4:Z scale\""));
  EXPECT_THAT(changed([](Ramp& r) { r.list.clear(); }), HasSubstr("neither a channel of the height nor"));
  EXPECT_THAT(changed([](Ramp& r) { r.list = "\\@Z scan size: V [Sens. Other] (1 V/LSB) 5 V\r\n"; }),
              HasSubstr("how long its ramp of 5 V is"));
  for (const char* samples : {"", "nan nan", "-5 20", "1e300 20", "20 2.5"}) {
    EXPECT_THAT(changed([&](Ramp& r) { r.samples = samples; }), HasSubstr("cannot read the curve a.spm: it"))
        << samples;
  }
  EXPECT_THAT(changed([](Ramp& r) { r.spring = "\\Spring Constant: nan\r\n"; }), HasSubstr("is no number"));
}

// Other programs write signs and other units into these headers.
TEST(NanoscopeCurve, IsTheSameInOtherUnits) {
  const double push_n = read(usual()).points[kPoints - 1].force.si;
  const auto push_of = [](const auto& change) {
    Ramp ramp = usual();
    change(ramp);
    return read(ramp).points[kPoints - 1].force.si;
  };
  const auto scale = [&](const char* text) { return push_of([=](Ramp& r) { r.channels[0].scale = text; }); };
  EXPECT_DOUBLE_EQ(scale("V [Sens. DeflSens] (0.0003750 V/LSB) 24576 mV"), push_n);
  EXPECT_DOUBLE_EQ(scale("V [Sens. DeflSens] (0.3750 mV/LSB) 24.576 V"), push_n);
  EXPECT_DOUBLE_EQ(scale("V [Sens. DeflSens] (+0.0003750 V/LSB) +24.576 V"), push_n);
  for (const char* sensitivity : {"+60.0 nm/V", "0.06 um/V", "60 pm/mV", "0.06 nm/mV"}) {
    const auto text = fmt::format("\\@Sens. DeflSens: V {}\r\n", sensitivity);
    EXPECT_NEAR(push_of([&](Ramp& r) { r.sensitivity = text; }) / push_n, 1.0, 1e-12) << sensitivity;
  }
  for (const char* spring : {"+0.32", "0.32 N/m", "320 mN/m", "0.32 nN/nm"}) {
    const auto text = fmt::format("\\Spring Constant: {}\r\n", spring);
    EXPECT_NEAR(push_of([&](Ramp& r) { r.spring = text; }) / push_n, 1.0, 1e-12) << spring;
  }
  Ramp torsion = usual();
  torsion.spring = "\\Spring Constant: 0.32 nN m\r\n";
  EXPECT_THAT(refusal(file_of(torsion)), HasSubstr("its spring constant is in \"nN m\", not in N/m"));
}

TEST(NanoscopeCurve, HasNoDataInItsHeader) {
  const std::string whole = file_of(usual());
  for (const char* offset : {"   0", " 500", "  -1"}) {
    std::string altered = whole;
    altered.replace(altered.find("\\Data offset: 4096") + 14, 4, offset);
    EXPECT_THAT(refusal(altered), HasSubstr("within its header: was the header altered?")) << offset;
  }
}

TEST(NanoscopeCurve, RefusesEveryCut) {
  const std::string whole = file_of(usual());
  EXPECT_EQ(refusal(whole), "accepted");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    if (size > 1200 && size < 4000) continue;  // zeros
    const auto cut = parse_curve(std::string_view(whole).substr(0, size), "cut.spm",
                                 {.spring_constant = {}, .sensitivity_m_per_v = {}, .index = 0, .confined = false});
    ASSERT_FALSE(cut.has_value()) << size;
    if (size < 40) continue;
    EXPECT_THAT(cut.error().message, HasSubstr("it is cut short")) << size;
    EXPECT_THAT(cut.error().message, HasSubstr("copy the file again from where it was saved")) << size;
  }
}

TEST(NanoscopeCurve, WithDecimalCommasIsRefused) {
  Ramp german = usual();
  german.spring = "\\Spring Constant: 1,32\r\n";
  EXPECT_THAT(refusal(file_of(german)),
              HasSubstr("a number of its header is \"1,32\", with a decimal comma; write a decimal point"));
}

}  // namespace nanoscope_curves_test
}  // namespace afm::curves
