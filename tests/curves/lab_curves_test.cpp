// SPDX-License-Identifier: Apache-2.0
// Curves, and files of other kinds, as laboratories bring them (tests/data/afm, synthetic, made from published
// layouts), and others of their kinds that are put together here.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "curves/curve_report.h"
#include "curves/image_file.h"
#include "curves/table_columns.h"
#include "physics/normal_generator.h"
#include "support/image_files.h"
#include "support/places.h"
#include "vendor_image_files.h"

namespace afm::curves {
namespace lab_curves_test {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kFourDigits = 1e-4;  // relative tolerance

std::string path_of(const std::string& name) { return support::source("tests/data/afm/" + name); }

AnalysedCurve curve(const std::string& name, const CurveReading& reading = {}) {
  auto loaded = load_curve(path_of(name), reading);
  EXPECT_TRUE(loaded.has_value()) << loaded.error().message;
  if (!loaded) return {};
  auto done = analysed(name, std::move(*loaded));
  EXPECT_TRUE(done.has_value()) << done.error().message;
  return done ? std::move(*done) : AnalysedCurve{};
}

std::string curve_refusal(const std::string& name, const CurveReading& reading = {}) {
  const auto loaded = load_curve(path_of(name), reading);
  return loaded ? "accepted" : loaded.error().message;
}

std::string image_refusal(const std::string& name) {
  const auto loaded = load_image(path_of(name));
  return loaded ? "accepted" : loaded.error().message;
}

std::ptrdiff_t points_of(const AnalysedCurve& curve, physics::Branch branch) {
  return std::count_if(curve.curve.points.begin(), curve.curve.points.end(),
                       [&](const auto& point) { return point.branch == branch; });
}
std::ptrdiff_t down(const AnalysedCurve& curve) { return points_of(curve, physics::Branch::Approach); }
std::ptrdiff_t up(const AnalysedCurve& curve) { return points_of(curve, physics::Branch::Retract); }

std::string remarks_of(const AnalysedCurve& curve) {
  return fmt::format("{}", fmt::join(curve.curve.metadata.remarks, "; "));
}

// 40 nN of push, of which the detector shows 25.
TEST(LabCurves, SayWhereTheDetectorEnds) {
  for (const double end_n : {25e-9, 1.0}) {
    physics::NormalGenerator noise(1);
    RecordedCurve recorded;
    for (int i = 0; i < 1000; ++i) {
      const double z_m = 2e-9 * (500 - i);
      recorded.points.push_back(
          {physics::Length(z_m), physics::Force(std::min(end_n, 0.04 * std::max(0.0, -z_m) + 2e-11 * noise()))});
    }
    const auto done = analysed("x", std::move(recorded));
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(remarks_of(*done).find("does the detector end there?") != std::string::npos, end_n < 1.0);
  }
}

TEST(LabFiles, AreRefusedByTheirTrueKind) {
  EXPECT_THAT(curve_refusal("ramp.spm"),
              HasSubstr("it is a Nanoscope force curve without a deflection; its channels are \"Height\""));
  EXPECT_THAT(image_refusal("ramp.spm"), HasSubstr("it is a curve, not an image"));
  EXPECT_THAT(curve_refusal("jpk-image.h5-jpk"), HasSubstr("no curve file of afmformats"));
  EXPECT_THAT(curve_refusal("jpk-image.h5-jpk"), HasSubstr("it begins with \"Measurement_000\""));
  EXPECT_THAT(curve_refusal("qnm-log.spm"), HasSubstr("it is an image, not a curve"));
  EXPECT_THAT(image_refusal("bom.tab"), HasSubstr("it is a curve, not an image"));
  const std::pair<std::string, std::string> kinds[]{
      {"version https://git-lfs.github.com/spec/v1\n", "a Git LFS pointer"},
      {"\x1f\x8b\x08 packed", "a gzip file; unpack it first"},
      {"<!DOCTYPE html><html>", "an HTML page"},
      {"\xff\xfe#", "a text in UTF-16; save it in UTF-8"},
      {"%PDF-1.7", "a PDF document"}};
  for (const auto& [bytes, kind] : kinds) {
    for (const auto& message : {parse_curve(bytes, "a.x").error().message, parse_image(bytes, "a.x").error().message}) {
      EXPECT_THAT(message, HasSubstr("it is " + kind));
    }
  }
  const std::string profile = test::park_image_file({.kind = 1}, ""),
                    spectroscopy = test::park_image_file({.kind = 2}, "");
  EXPECT_THAT(parse_image(profile, "a.tiff").error().message, HasSubstr("a line profile of Park Systems"));
  EXPECT_THAT(parse_image(spectroscopy, "a.tiff").error().message, HasSubstr("a spectroscopy of Park Systems"));
}

constexpr double kPush_nN = 15.49, kSpringConstant = 0.05;

void expect_the_usual_curve(const AnalysedCurve& read, std::ptrdiff_t retract = 150) {
  EXPECT_EQ(down(read), 150);
  EXPECT_EQ(up(read), retract);
  ASSERT_TRUE(read.curve.metadata.spring_constant.has_value());
  EXPECT_DOUBLE_EQ(read.curve.metadata.spring_constant->si, kSpringConstant);
  EXPECT_NEAR(read.features.greatest_push.si * 1e9, kPush_nN, 0.005);
}

TEST(LabCurves, AreReadAroundWhatEditorsAndCommentsAdd) {
  for (const char* name : {"bom.tab", "comment-commas.csv"}) {
    const AnalysedCurve read = curve(name);
    expect_the_usual_curve(read);
    EXPECT_EQ(remarks_of(read), "") << name;
  }
  EXPECT_TRUE(is_curve_file(path_of("bom.tab")));
}

TEST(LabCurves, MayHaveBranchesOfDifferentLength) {
  expect_the_usual_curve(curve("uneven.csv"), 120);
  auto text = core::read_file(path_of("uneven.csv"));
  ASSERT_TRUE(text.has_value());
  const auto gap = parse_curve(*text + "1600.0,15.5,1600.0,15.5\r\n", "gap.csv");
  ASSERT_FALSE(gap.has_value());
  EXPECT_THAT(gap.error().message, HasSubstr("the retract goes on behind empty fields"));
}

TEST(LabCurves, LeaveOutARestAndSayIt) {
  for (const auto& [name, rest] :
       {std::pair("short-approach-dwell.jpk-force", "the tip rests at constant height for 1 s: 60 points"),
        std::pair("modulation.jpk-force", "the tip is in a segment \"modulation\" for 2 s: 60 points"),
        std::pair("segments-012.tab", "the tip rests: 40 points")}) {
    const AnalysedCurve read = curve(name);
    expect_the_usual_curve(read);
    EXPECT_THAT(remarks_of(read), HasSubstr(std::string("between approach and retract ") + rest));
    EXPECT_THAT(features_text(read, nullptr), HasSubstr(std::string("remark: between approach and retract ") + rest));
    EXPECT_EQ(features_json(read, nullptr).at("remarks").size(), 1U);
  }
}

TEST(LabCurves, OfAsylumAreSplitByTheirIndexes) {
  const AnalysedCurve read = curve("dwell.ibw");
  EXPECT_EQ(down(read), 200);
  EXPECT_EQ(up(read), 200);
  EXPECT_THAT(remarks_of(read), HasSubstr("between approach and retract the tip rests: 200 points"));
  EXPECT_NEAR(read.features.contact_slope->si / 11.33e-3, 1.0, 0.02);
  EXPECT_NEAR(read.features.greatest_push.si * 1e9, 8.891, 0.0005);
}

TEST(LabCurves, OfAsylumWithoutIndexesSayThatADwellIsSomewhere) {
  auto bytes = core::read_file(path_of("dwell.ibw"));
  ASSERT_TRUE(bytes.has_value());
  std::string unknown = *bytes;
  unknown.replace(unknown.find("Indexes"), 7, "Xndexes");
  const auto dwelt = parse_curve(unknown, "a.ibw");
  ASSERT_TRUE(dwelt.has_value()) << dwelt.error().message;
  EXPECT_THAT(dwelt->metadata.remarks, ElementsAre(HasSubstr("it is split where it is deepest")));
  // Indexes of three sections are enough
  std::string no_direction = *bytes;
  no_direction.replace(no_direction.find("Direction"), 9, "Xirection");
  const auto split = parse_curve(no_direction, "a.ibw");
  ASSERT_TRUE(split.has_value()) << split.error().message;
  EXPECT_EQ(split->points.size(), 400U);
}

TEST(LabCurves, OfAsylumWithoutACalibrationTakeOne) {
  EXPECT_THAT(curve_refusal("k-nan.ibw"), HasSubstr("no valid SpringConstant; give --spring-constant"));
  const CurveReading reading{.spring_constant = physics::Stiffness(0.05), .sensitivity_m_per_v = {}};
  EXPECT_NEAR(curve("k-nan.ibw", reading).features.greatest_push.si * 1e9, 8.891, 0.0005);
  EXPECT_THAT(remarks_of(curve("k-nan.ibw", reading)), HasSubstr("the tip rests: 1 point there is left out"));
  // the key is missing, zero, or not there at all
  auto bytes = core::read_file(path_of("k-nan.ibw"));
  ASSERT_TRUE(bytes.has_value());
  for (const char* other : {"SpringConstant: 0  ", "Xpringconstant: NaN"}) {
    std::string changed = *bytes;
    changed.replace(changed.find("SpringConstant: NaN"), 19, other);
    const auto refused = parse_curve(changed, "a.ibw");
    ASSERT_FALSE(refused.has_value());
    EXPECT_THAT(refused.error().message, HasSubstr("give --spring-constant"));
    const auto taken = parse_curve(changed, "a.ibw", reading);
    ASSERT_TRUE(taken.has_value()) << taken.error().message;
    EXPECT_DOUBLE_EQ(taken->metadata.spring_constant->si, 0.05);
  }
}

TEST(LabCurves, TakeTheHeightThatTheInstrumentShows) {
  const AnalysedCurve read = curve("calibrated-alone.jpk-force");
  expect_the_usual_curve(read);
  const auto [low, high] = std::minmax_element(read.curve.points.begin(), read.curve.points.end(),
                                               [](const auto& a, const auto& b) { return a.z < b.z; });
  EXPECT_NEAR((high->z - low->z).si / 1400e-9, 1.0, kFourDigits);
}

TEST(LabCurves, WhoseHeightsRiseAreTurnedWithAWord) {
  const AnalysedCurve read = curve("rising.tab");
  expect_the_usual_curve(read);
  EXPECT_THAT(remarks_of(read), HasSubstr("its heights rise while the tip approaches"));
  ASSERT_TRUE(read.features.contact_point.has_value());
  EXPECT_NEAR(read.features.contact_point->si, 0.0, 60e-9);
  EXPECT_NEAR(read.features.baseline.level.si, 0.0, 0.1e-9);
}

TEST(LabCurves, ThatNeverPushAreSaidToHaveAWrongSign) {
  const AnalysedCurve read = curve("sign.tab");
  EXPECT_THAT(remarks_of(read), HasSubstr("where it should be pushed: is the sign of the sensitivity wrong?"));
  EXPECT_FALSE(read.features.contact_point.has_value());
  const std::string text = features_text(read, nullptr);
  EXPECT_THAT(text, HasSubstr("places are from the zero of the file's own heights"));
  EXPECT_THAT(text, testing::Not(HasSubstr("contact point; ")));
  EXPECT_EQ(features_json(read, nullptr).at("places_are_from"), "the zero of the file's own heights");
  EXPECT_THAT(features_plot(read, nullptr).x_label, HasSubstr("the file's own heights"));
}

// Every sign and order that another program may write, made of the same curve.
enum class Turned { Heights, Order, Branches, Retract };

std::string turned_tab(Turned how) {
  const auto read = load_curve(path_of("bom.tab"));
  if (!read) return {};
  RecordedCurve turned = *read;
  std::vector<physics::CurvePoint> approach(turned.points.begin(), turned.points.begin() + 150),
      retract(turned.points.begin() + 150, turned.points.end());
  if (how == Turned::Heights) {
    for (auto* branch : {&approach, &retract}) {
      for (auto& point : *branch) point.z = -point.z;
    }
  }
  if (how == Turned::Order) std::reverse(approach.begin(), approach.end());
  if (how == Turned::Retract) std::reverse(retract.begin(), retract.end());
  if (how == Turned::Branches) std::swap(approach, retract);
  for (auto& point : approach) point.branch = physics::Branch::Approach;
  for (auto& point : retract) point.branch = physics::Branch::Retract;
  turned.points = approach;
  turned.points.insert(turned.points.end(), retract.begin(), retract.end());
  return curve_bytes(CurveFormat::Tab, turned).value();
}

TEST(LabCurves, OfAnyOrderAreTheSame) {
  const AnalysedCurve straight = curve("bom.tab");
  for (const auto& [how, word] :
       {std::pair(Turned::Heights, "heights rise"), std::pair(Turned::Order, "the points of its approach lead away"),
        std::pair(Turned::Retract, "the points of its retract lead towards"),
        std::pair(Turned::Branches, "its first part leads away from the sample")}) {
    auto read = parse_curve(turned_tab(how), "turned.tab");
    ASSERT_TRUE(read.has_value()) << read.error().message;
    const auto done = analysed("turned", std::move(*read));
    ASSERT_TRUE(done.has_value());
    EXPECT_THAT(remarks_of(*done), HasSubstr(word));
    EXPECT_EQ(done->features.greatest_push, straight.features.greatest_push);
    EXPECT_EQ(done->features.contact_point, straight.features.contact_point);
    EXPECT_EQ(done->features.loop_energy, straight.features.loop_energy);
  }
}

TEST(LabCurves, InNewtonsSayThatACalibrationChangesNothing) {
  auto bytes = core::read_file(path_of("bom.tab"));
  ASSERT_TRUE(bytes.has_value());
  const std::string line = ",\n#   \"spring constant\": 0.05";
  ASSERT_NE(bytes->find(line), std::string::npos);
  for (const char* none : {"", ",\n#   \"spring constant\": 0"}) {
    const std::string no_lever = std::string(*bytes).replace(bytes->find(line), line.size(), none);
    const auto read =
        parse_curve(no_lever, "a.tab", {.spring_constant = physics::Stiffness(0.1), .sensitivity_m_per_v = {}});
    ASSERT_TRUE(read.has_value()) << read.error().message;
    EXPECT_THAT(read->metadata.remarks, ElementsAre(HasSubstr("they do not change")));
  }
}

// Lines as written by Fortran and LabVIEW; an editor may leave blanks at their ends.
TEST(LabCurves, MayHaveSignsAndBlanksBehindTheirLines) {
  const auto bytes = core::read_file(path_of("bom.tab"));
  ASSERT_TRUE(bytes.has_value());
  const auto plain = parse_curve(*bytes, "a.tab");
  ASSERT_TRUE(plain.has_value());
  const auto signed_numbers = parse_curve(std::regex_replace(*bytes, std::regex("\t([0-9])"), "\t+$1"), "a.tab");
  ASSERT_TRUE(signed_numbers.has_value()) << signed_numbers.error().message;
  EXPECT_EQ(curve_bytes(CurveFormat::Tab, *signed_numbers).value(), curve_bytes(CurveFormat::Tab, *plain).value());
  const auto own = core::read_file(support::source("tests/fuzz/corpus/curve_files/touchafm.csv"));
  ASSERT_TRUE(own.has_value());
  const auto blanks = parse_curve(std::regex_replace(*own, std::regex("\n"), " \n"), "a.csv");
  ASSERT_TRUE(blanks.has_value()) << blanks.error().message;
  EXPECT_EQ(blanks->points.size(), parse_curve(*own, "a.csv")->points.size());
}

// Down by 40 steps of 20 nm and back under a lever of 0.1 N/m, 0.5 nN a step from the 25th on; `row` writes the height
// of the base in nm and the force in nN.
template <class Row>
std::string lab_table(const Row& row) {
  std::string text;
  for (int i = 0; i < 80; ++i) {
    const int step = i < 40 ? i : 79 - i;
    text += row(1000.0 - 20.0 * step, (step < 25 ? -0.125 : 0.5 * (step - 25)) + (i < 40 ? 0.0 : 0.25));
  }
  return text;
}

RecordedCurve lab_curve(const std::string& text, const char* columns) {
  CurveReading reading;
  const auto parsed = parse_table_columns(columns);
  EXPECT_TRUE(parsed) << parsed.error().message;
  reading.columns = *parsed;
  reading.spring_constant = physics::Stiffness(0.1);
  auto curve = parse_curve(text, "a.txt", reading);
  EXPECT_TRUE(curve) << columns << ": " << curve.error().message;
  return curve ? std::move(*curve) : RecordedCurve{};
}

void expect_same(const RecordedCurve& curve, const RecordedCurve& other, const char* what) {
  ASSERT_EQ(curve.points.size(), other.points.size()) << what;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    ASSERT_NEAR(curve.points[i].z.si, other.points[i].z.si, 1e-18) << what << ", point " << i;
    ASSERT_NEAR(curve.points[i].force.si, other.points[i].force.si, 1e-18) << what << ", point " << i;
    ASSERT_EQ(curve.points[i].branch, other.points[i].branch) << what << ", point " << i;
  }
}

// Bruker's "separation": the base's height plus the lever's deflection.
TEST(LabTables, MayHaveThePositionOfTheTip) {
  const auto plain = [](double z, double f) { return fmt::format("{} {}\n", z, f); };
  const RecordedCurve curve = lab_curve(lab_table(plain), "height:nm force:nN");
  const auto of_tip = [](double z, double f) { return fmt::format("{} {}\n", z + f / 0.1, f); };
  expect_same(lab_curve(lab_table(of_tip), "tip-position:nm force:nN"), curve, "force");
  const auto deflected = [](double z, double f) { return fmt::format("{} {}\n", z + f / 0.1, f / 0.1); };
  expect_same(lab_curve(lab_table(deflected), "tip-position:nm deflection:nm"), curve, "deflection");
  EXPECT_THAT(lab_curve("separation (nm) force\n" + lab_table(of_tip), "tip-position:nm force:nN").metadata.remarks,
              testing::IsEmpty());
  EXPECT_THAT(
      lab_curve("Separation_nm force_nN\n" + lab_table(of_tip), "height:nm force:nN").metadata.remarks,
      ElementsAre(HasSubstr("if it is the position of the tip, and not of the lever's base, call it tip-position")));
  CurveReading unknown;
  unknown.columns = *parse_table_columns("tip-position:nm force:nN");
  EXPECT_THAT(parse_curve(lab_table(of_tip), "a.txt", unknown).error().message, HasSubstr("give --spring-constant"));
}

TEST(LabTables, MayHaveTheWayBackAtOtherHeights) {
  std::vector<std::pair<double, double>> points;
  lab_table([&](double z, double f) {
    points.emplace_back(z, f);
    return "";
  });
  const auto beside = [&](bool of_tip, bool reversed) {
    std::string text;
    for (std::size_t i = 0; i < 40; ++i) {
      const auto [z, f] = points[i];
      const auto [back_z, back_f] = points[reversed ? 79 - i : 40 + i];
      const double k = of_tip ? 0.1 : std::numeric_limits<double>::infinity();
      text += fmt::format("{};{};{};{}\n", z + f / k, f, 7.0 + back_z + back_f / k, back_f);
    }
    return text;
  };
  RecordedCurve curve =
      lab_curve(lab_table([](double z, double f) { return fmt::format("{} {}\n", z, f); }), "height:nm force:nN");
  for (std::size_t i = 40; i < 80; ++i) curve.points[i].z = curve.points[i].z + physics::Length(7e-9);
  for (const bool reversed : {false, true}) {
    expect_same(lab_curve(beside(false, reversed), "height:nm force:nN retract-height:nm retract-force:nN"), curve,
                reversed ? "base, reversed" : "base");
    expect_same(lab_curve(beside(true, reversed), "tip-position:nm force:nN retract-tip-position:nm retract-force:nN"),
                curve, reversed ? "tip, reversed" : "tip");
  }
  for (const char* wrong :
       {"height:nm force:nN retract-height:nm", "retract-height:nm retract-force:nN force:nN",
        "height:nm force:nN retract-tip-position:nm retract-force:nN", "tip-position:nm height:nm force:nN"}) {
    EXPECT_FALSE(parse_table_columns(wrong)) << wrong;
  }
}

// Windows writes U+2212 in Swedish and other languages.
TEST(LabTables, MayHaveUnicodesMinus) {
  const auto plain = [](double z, double f) { return fmt::format("{} {:e}\n", z - 700.0, f); };
  const auto unicode = [&](double z, double f) {
    return std::regex_replace(plain(z, f), std::regex("-"), std::string("\u2212"));
  };
  expect_same(lab_curve(lab_table(unicode), "height:nm force:nN"), lab_curve(lab_table(plain), "height:nm force:nN"),
              "minus");
}

}  // namespace lab_curves_test
}  // namespace afm::curves
