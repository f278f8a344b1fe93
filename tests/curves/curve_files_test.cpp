// SPDX-License-Identifier: Apache-2.0
#include "curves/curve_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/whole_file.h"
#include "support/deep.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace curve_files_test {

using testing::AnyOf;
using testing::HasSubstr;

std::string error_of(std::string_view bytes, const CurveReading& reading = {}) {
  const auto curve = parse_curve(bytes, "curve.x", reading);
  if (curve) return "accepted";
  EXPECT_EQ(curve.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(curve.error().message, HasSubstr("curve.x: "));
  EXPECT_EQ(curve.error().message.find('\n'), std::string::npos);
  return curve.error().message;
}

// A paper curve, whose approach and retract differ in length and whose jumps are two points at one height.
RecordedCurve adhesive_curve() {
  const physics::ContactParameters mica{.tip_radius = physics::Length(50e-9),
                                        .spring_constant = physics::Stiffness(0.1),
                                        .sample_stiffness = physics::Stiffness(std::numeric_limits<double>::infinity()),
                                        .hamaker = physics::Energy(24.5e-21),
                                        .mean_surface_energy = physics::SurfaceEnergy(2.228e-3)};
  const auto curve = physics::record_curve(physics::ApproachRetractModel(mica),
                                           {physics::Length(20e-9), physics::Length(-5e-9), physics::Length(0.05e-9)});
  RecordedCurve recorded = recorded_curve(curve, mica.spring_constant);
  recorded.metadata.approach_speed = physics::Velocity(1e-6);
  recorded.metadata.sensitivity_m_per_v = 91.2e-9;
  recorded.metadata.setpoint = physics::Force(0.5e-9);
  recorded.metadata.date = "2020-02-14";
  recorded.metadata.time = "13:41:26";
  recorded.metadata.curve_id = "mica, \"paper\" \xC2\xB5";
  return recorded;
}

class Format : public testing::TestWithParam<CurveFormat> {};

TEST_P(Format, GivesAHertzCurveAndItsModulusBack) {
  const RecordedCurve written = test::hertz_curve();
  const auto bytes = curve_bytes(GetParam(), written);
  ASSERT_TRUE(bytes.has_value()) << bytes.error().message;
  const auto read = parse_curve(*bytes, "hertz");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_EQ(read->points.size(), written.points.size());
  EXPECT_NEAR(test::fitted_modulus_pa(*read) / test::kHertzModulusPa, 1.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(CurveFiles, Format,
                         testing::Values(CurveFormat::Tab, CurveFormat::Hdf5, CurveFormat::AfmWorkshop));

class ExactFormat : public testing::TestWithParam<CurveFormat> {};

TEST_P(ExactFormat, GivesEveryPointAndEntryBack) {
  const RecordedCurve written = adhesive_curve();
  const auto bytes = curve_bytes(GetParam(), written);
  ASSERT_TRUE(bytes.has_value()) << bytes.error().message;
  const auto read = parse_curve(*bytes, "mica");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  ASSERT_EQ(read->points.size(), written.points.size());
  for (std::size_t i = 0; i < read->points.size(); ++i) {
    ASSERT_EQ(read->points[i].z, written.points[i].z) << i;
    ASSERT_EQ(read->points[i].force, written.points[i].force) << i;
    ASSERT_EQ(read->points[i].branch, written.points[i].branch) << i;
  }
  EXPECT_EQ(read->metadata.spring_constant, written.metadata.spring_constant);
  EXPECT_EQ(read->metadata.sensitivity_m_per_v, written.metadata.sensitivity_m_per_v);
  EXPECT_EQ(read->metadata.approach_speed, written.metadata.approach_speed);
  EXPECT_FALSE(read->metadata.retract_speed);
  EXPECT_EQ(read->metadata.setpoint, written.metadata.setpoint);
  EXPECT_EQ(read->metadata.software, "TouchAFM");
  EXPECT_EQ(read->metadata.date, "2020-02-14");
  EXPECT_EQ(read->metadata.time, "13:41:26");
  EXPECT_EQ(read->metadata.curve_id, written.metadata.curve_id);
  EXPECT_TRUE(read->time_s.empty());
}

TEST_P(ExactFormat, KeepsTheTimes) {
  RecordedCurve written = test::hertz_curve();
  for (std::size_t i = 0; i < written.points.size(); ++i) written.time_s.push_back(0.001 * static_cast<double>(i));
  const auto read = parse_curve(*curve_bytes(GetParam(), written), "hertz");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->time_s, written.time_s);
}

TEST_P(ExactFormat, RefusesEveryCutOfAFile) {
  const std::string bytes = *curve_bytes(GetParam(), adhesive_curve());
  const int parts = support::draws(40);
  for (int part = 0; part < parts; ++part) {
    const std::size_t size = static_cast<std::size_t>(part) * bytes.size() / static_cast<std::size_t>(parts);
    EXPECT_THAT(error_of(std::string_view(bytes).substr(0, size)), HasSubstr("cannot read the curve")) << size;
  }
}

INSTANTIATE_TEST_SUITE_P(CurveFiles, ExactFormat, testing::Values(CurveFormat::Tab, CurveFormat::Hdf5));

// Editors and old Macs.
TEST(CurveTexts, AreReadWithOtherLineEnds) {
  for (const CurveFormat format : {CurveFormat::Tab, CurveFormat::AfmWorkshop}) {
    std::string bytes = *curve_bytes(format, adhesive_curve());
    std::erase(bytes, '\r');
    const auto plain = parse_curve(bytes, "mica");
    ASSERT_TRUE(plain) << plain.error().message;
    std::replace(bytes.begin(), bytes.end(), '\n', '\r');
    const auto old = parse_curve(bytes, "mica");
    ASSERT_TRUE(old) << old.error().message;
    EXPECT_EQ(old->points.size(), plain->points.size());
  }
  std::string bytes = *curve_bytes(CurveFormat::Tab, adhesive_curve());
  bytes.pop_back();
  EXPECT_THAT(error_of(bytes), HasSubstr("its last line has no end, and may have lost digits"));
}

TEST(CurveTexts, SayThatTheyAreCutInTheirTable) {
  for (const CurveFormat format : {CurveFormat::Tab, CurveFormat::AfmWorkshop}) {
    const std::string bytes = *curve_bytes(format, adhesive_curve());
    for (std::size_t size = bytes.size() - 150; size < bytes.size() - 2; ++size) {
      const std::string cut = bytes.substr(0, size);
      if (format == CurveFormat::AfmWorkshop && (cut.ends_with('\r') || cut.ends_with('\n')))
        continue;  // a shorter curve
      const auto read = parse_curve(cut, "cut");
      std::string said = read ? "" : read.error().message;
      if (read) {
        for (const std::string& remark : read->metadata.remarks) said += remark;
      }
      EXPECT_THAT(said, AnyOf(HasSubstr("it is cut short: "), HasSubstr("its last line has no end"))) << size;
    }
  }
}

TEST(CurveTexts, AreNamedWithTheirNuls) {
  std::string bytes = *curve_bytes(CurveFormat::Tab, adhesive_curve());
  bytes.replace(bytes.size() - 20, 3, 3, '\0');
  EXPECT_THAT(error_of(bytes), HasSubstr(", not a finite number"));
}

TEST(AfmWorkshopFile, HasEvenHeightsAndKeepsTheFiguresOfTheCurve) {
  const RecordedCurve written = adhesive_curve();
  const std::string bytes = *curve_bytes(CurveFormat::AfmWorkshop, written);
  EXPECT_THAT(bytes, HasSubstr("Date:\tFriday, February 14, 2020\r\n"));
  EXPECT_THAT(bytes, HasSubstr("\r\nExtend Z-Sense(nm),Extend Force(nN),Retract Z-Sense(nm),Retract Force(nN)\r\n"));
  const auto read = parse_curve(bytes, "mica");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->metadata.date, "2020-02-14");
  EXPECT_EQ(read->metadata.spring_constant, written.metadata.spring_constant);
  ASSERT_EQ(read->points.size() % 2, 0U);
  const std::size_t half = read->points.size() / 2;
  const double step = (read->points[1].z - read->points[0].z).si;
  const double step_back = (read->points[half + 1].z - read->points[half].z).si;
  for (std::size_t i = 1; i < half; ++i) {
    ASSERT_NEAR((read->points[i].z - read->points[i - 1].z).si / step, 1.0, 1e-3);
    ASSERT_NEAR((read->points[half + i].z - read->points[half + i - 1].z).si / step_back, 1.0, 1e-3);
  }
  const auto exact = physics::analyse(written.points), even = physics::analyse(read->points);
  // a jump may fall anywhere within one of the steps
  EXPECT_NEAR((even.pull_off->z - exact.pull_off->z).si / step, 0.0, 1.0);
  EXPECT_NEAR(even.pull_off->force / exact.pull_off->force, 1.0, 0.005);
  EXPECT_NEAR(even.loop_energy / exact.loop_energy, 1.0, 0.005);
}

TEST(AfmWorkshopFile, InVoltsNeedsACalibrationAndTakesIt) {
  std::string text =
      "Force-Distance Curve\r\nDate:\t15 January 2021\r\n\r\n"
      "Extend Z-Sense(nm),Extend T-B(V),Retract Z-Sense(nm),Retract T-B(V)\r\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(i) + ",0.5," + std::to_string(20 - i) + ",0.25\r\n";
  EXPECT_THAT(error_of(text), HasSubstr("in volts; give --sensitivity and --spring-constant"));
  const auto read = parse_curve(text, "v", {.spring_constant = physics::Stiffness(0.2), .sensitivity_m_per_v = 50e-9});
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->metadata.date, "2021-01-15");
  EXPECT_DOUBLE_EQ(read->points.front().force.si, 0.5 * 50e-9 * 0.2);
  EXPECT_DOUBLE_EQ(read->points[1].z.si, -1e-9);
}

// Gwyddion and afmformats take no file without a date.
TEST(AfmWorkshopFile, HasADateAndATimeWhereNoneAreKnown) {
  RecordedCurve written = adhesive_curve();
  written.metadata.date.clear();
  written.metadata.time.clear();
  const std::string bytes = *curve_bytes(CurveFormat::AfmWorkshop, written);
  EXPECT_THAT(bytes, HasSubstr("\r\nDate:\tThursday, January 1, 1970\r\nTime:\t12:00:00 AM\r\n"));
  const auto read = parse_curve(bytes, "mica");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->metadata.date, "");
  EXPECT_EQ(read->metadata.time, "");
}

TEST(AfmWorkshopFile, KeepsATextOfSeveralLinesInItsOwn) {
  RecordedCurve written = adhesive_curve();
  written.metadata.instrument = "an AFM\nTouchAFM speed approach:\t5";
  const auto read = parse_curve(curve_bytes(CurveFormat::AfmWorkshop, written).value(), "mica");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->metadata.instrument, "an AFM TouchAFM speed approach: 5");
  EXPECT_EQ(read->metadata.approach_speed, written.metadata.approach_speed);
}

TEST(CurveTexts, OfAFileCannotCommandATerminal) {
  RecordedCurve written = adhesive_curve();
  written.metadata.instrument = "AFM\x1b[2J\nx";
  written.metadata.curve_id = "a\tb";
  const auto read = parse_curve(curve_bytes(CurveFormat::Tab, written).value(), "mica");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->metadata.instrument, "AFM\uFFFD[2J x");
  EXPECT_EQ(read->metadata.curve_id, "a b");
}

TEST(TouchAfmCsv, IsReadBack) {
  std::string text =
      "# TouchAFM force-displacement curve\n# material: mica\n# spring_constant_N_per_m: 0.1\nz_m,force_N,branch\n";
  for (int i = 0; i < 12; ++i) text += std::to_string(-i) + "e-9,1e-10,approach\n";
  for (int i = 0; i < 12; ++i) text += std::to_string(i - 12) + "e-9,-1e-10,retract\n";
  const auto read = parse_curve(text, "mica.csv");
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->points.size(), 24U);
  EXPECT_EQ(read->metadata.spring_constant, physics::Stiffness(0.1));
  EXPECT_EQ(read->metadata.curve_id, "mica");
  EXPECT_THAT(error_of(text + "1e-9,1e-9,sideways\n"), HasSubstr("line 29: branch is \"sideways\""));
  EXPECT_THAT(error_of(text + "1e-9,nan,retract\n"), HasSubstr("line 29: force_N is \"nan\", not a finite number"));
  EXPECT_THAT(error_of(text.substr(0, text.size() / 2)), HasSubstr("cannot read the curve"));
  EXPECT_THAT(error_of(text.substr(0, text.size() - 1)), HasSubstr("it is cut short"));
  const std::string counted = text.substr(0, text.find("z_m,")) + "# samples: 100\n" + text.substr(text.find("z_m,"));
  EXPECT_THAT(error_of(counted), HasSubstr("samples are there"));
  EXPECT_THAT(error_of(text + "1e-9\n"), HasSubstr("line 29 has 1 field, the heading 3"));
  EXPECT_THAT(error_of(text + "1e-9,1e-9,approach\n"), HasSubstr("were its rows sorted?"));
  EXPECT_THAT(error_of(text + "20,1e-9,retract\n"), HasSubstr("range of a force microscope; is it in SI?"));
  EXPECT_THAT(error_of(text + "1e-9,1e-9,approach\n1e-9,1e-9,retract\n"),
              HasSubstr("does not approach once and retract once"));
}

TEST(CurveFiles, AGivenSpringConstantReplacesTheFilesOwn) {
  const RecordedCurve written = adhesive_curve();
  const std::string bytes = *curve_bytes(CurveFormat::Tab, written);
  const auto read = parse_curve(bytes, "mica", {.spring_constant = physics::Stiffness(0.2), .sensitivity_m_per_v = {}});
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->metadata.spring_constant, physics::Stiffness(0.2));
  EXPECT_DOUBLE_EQ(read->points[450].force.si, 2.0 * written.points[450].force.si);
}

TEST(CurveFiles, RefuseWhatIsNoForceDistanceCurve) {
  EXPECT_THAT(error_of(""), HasSubstr("it is an empty file"));
  EXPECT_THAT(error_of("hello"), HasSubstr("no curve of a known kind"));
  std::string creep = *curve_bytes(CurveFormat::Tab, adhesive_curve());
  creep.replace(creep.find("force-distance"), 14, "creep-complian");
  EXPECT_THAT(error_of(creep), HasSubstr("only force-distance curves are read"));
  std::string unbalanced = *curve_bytes(CurveFormat::Tab, adhesive_curve());
  unbalanced.replace(unbalanced.find("# {"), 3, "#  ");
  EXPECT_THAT(error_of(unbalanced), HasSubstr("its metadata is no valid JSON"));
}

TEST(CurveFiles, RefuseAFileThatIsTooLargeBeforeReadingIt) {
  const support::ScratchFolder folder;
  const std::string path = folder.write("large.tab", "#");
  std::filesystem::resize_file(path, std::uintmax_t{300} << 20U);  // sparse file
  const auto read = load_curve(path);
  ASSERT_FALSE(read.has_value());
  EXPECT_THAT(read.error().message, HasSubstr("larger than 256 MiB"));
}

TEST(Hdf5File, RefusesACurveThatItDoesNotHold) {
  const std::string bytes = *curve_bytes(CurveFormat::Hdf5, adhesive_curve());
  EXPECT_THAT(error_of(bytes, {.spring_constant = {}, .sensitivity_m_per_v = {}, .index = 3}),
              HasSubstr("it has no curve \"3\""));
}

// HDF5 1.10 crashes, loops and asks for absurd amounts of memory on such files; this process must not.
TEST(Hdf5File, SurvivesDamageAnywhere) {
  const std::string whole = *curve_bytes(CurveFormat::Hdf5, adhesive_curve());
  int refused = 0;
  const std::size_t step = support::deep() ? 61 : 607;
  for (std::size_t i = 8; i < 4096 && i < whole.size(); i += step) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0xff);
    const auto read = parse_curve(damaged, "damaged.h5");
    if (!read) ++refused;
  }
  EXPECT_GT(refused, 0);
}

TEST(CurveFiles, AreWrittenWholeOrRefused) {
  const support::ScratchFolder folder;
  ASSERT_TRUE(write_curve(folder.file("c.h5"), CurveFormat::Hdf5, adhesive_curve()).has_value());
  EXPECT_TRUE(load_curve(folder.file("c.h5")).has_value());
  const auto refused = write_curve(folder.file("c.ibw"), CurveFormat::IgorBinaryWave, adhesive_curve());
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_FALSE(std::filesystem::exists(folder.file("c.ibw")));
}

}  // namespace curve_files_test
}  // namespace afm::curves
