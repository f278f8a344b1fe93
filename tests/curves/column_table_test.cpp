// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "curves/curve_file.h"
#include "curves/table_columns.h"
#include "physics/normal_generator.h"

namespace afm::curves {
namespace column_table_test {

using physics::Branch;
using testing::HasSubstr;

CurveReading columns(const std::string& text) {
  CurveReading reading;
  auto parsed = parse_table_columns(text);
  EXPECT_TRUE(parsed) << parsed.error().message;
  if (parsed) reading.columns = *parsed;
  return reading;
}

// Down by 12 steps of 0.1 um and back; the force is 2 nN at the deepest point.
std::string table(const char* separator, bool decimal_commas = false) {
  std::string text = "exported by another program\nheight" + std::string(separator) + "force\n\n# a remark\n";
  for (int i = 0; i <= 24; ++i) {
    const int step = i <= 12 ? i : 24 - i;
    std::string row = fmt::format("{:.2f}{}{:.2f}", 1.2 - 0.1 * step, separator, step < 8 ? 0.0 : 0.5 * (step - 8));
    if (decimal_commas) std::replace(row.begin(), row.end(), '.', ',');
    text += row + "\r\n";
  }
  return text;
}

std::string refusal(const std::string& bytes, const CurveReading& reading) {
  const auto curve = parse_curve(bytes, "a.txt", reading);
  return curve ? "accepted" : curve.error().message;
}

TEST(ColumnTable, IsReadWhateverSeparatesItsColumns) {
  for (const char* separator : {"\t", ";", ",", "  ", " \t "}) {
    for (const bool commas : {false, true}) {
      if (commas && std::string(separator) == ",") continue;
      const auto curve = parse_curve(table(separator, commas), "a.txt", columns("height:um force:nN"));
      ASSERT_TRUE(curve) << separator << curve.error().message;
      ASSERT_EQ(curve->points.size(), 25U);
      EXPECT_NEAR(curve->points[0].z.si, 1.2e-6, 1e-18);
      EXPECT_NEAR(curve->points[12].force.si, 2e-9, 1e-21);
      EXPECT_EQ(curve->points[12].branch, Branch::Approach);
      EXPECT_EQ(curve->points[13].branch, Branch::Retract);
    }
  }
}

TEST(ColumnTable, TurnsWhereTheHeightDoesWhicheverWayItCounts) {
  std::string text;
  for (int i = 0; i <= 24; ++i) {
    const int step = i <= 12 ? i : 24 - i;
    text += fmt::format("{} {}\n", 100 * step, step < 8 ? 0 : step - 8);
  }
  const auto curve = parse_curve(text, "a.txt", columns("height:nm force:nN"));
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_GT(curve->points[0].z, curve->points[12].z) << "heights fall on the approach";
  EXPECT_EQ(curve->points[12].branch, Branch::Approach);
  EXPECT_EQ(curve->points[13].branch, Branch::Retract);
}

TEST(ColumnTable, OfOneWayHasNoTurnInItsNoise) {
  std::string text;
  for (int i = 0; i < 300; ++i)
    text += fmt::format("{} {}\n", 3000 - 10 * i + (i % 3 == 1 ? 25 : 0), i < 200 ? 0 : i - 200);
  const auto curve = parse_curve(text, "a.txt", columns("height:nm force:pN"));
  ASSERT_TRUE(curve) << curve.error().message;
  for (const auto& point : curve->points) EXPECT_EQ(point.branch, Branch::Approach);
}

// A wave of Igor that is longer than the others fills them up.
TEST(ColumnTable, LeavesOutAnEndWithoutNumbers) {
  const CurveReading two = columns("height:um force:nN");
  const std::size_t whole = parse_curve(table(";"), "a.csv", two)->points.size();
  for (const auto& [end, said] :
       {std::pair("NaN;NaN\n", "the last line is left out"), std::pair("nan;nan\n;\n", "the last 2 lines are"),
        std::pair(";\n;\n", "the last 2 lines are"), std::pair("; nan\n\n", "the last line is")}) {
    const auto curve = parse_curve(table(";") + end, "a.csv", two);
    ASSERT_TRUE(curve) << curve.error().message;
    EXPECT_EQ(curve->points.size(), whole);
    EXPECT_THAT(curve->metadata.remarks, testing::Contains(HasSubstr(said))) << end;
  }
  EXPECT_THAT(refusal(table(";") + "NaN;NaN\n1;2\n", two),
              HasSubstr("line 31 has numbers, and the line before it none"));
}

TEST(ColumnTable, WithTheRowsOfTwoCurvesIsRefused) {
  std::string cycle;
  for (int i = 0; i <= 24; ++i)
    cycle += fmt::format("{} {}\n", 100 * std::abs(12 - i), std::max(0, 4 - std::abs(12 - i)));
  const CurveReading two = columns("height:nm force:nN");
  EXPECT_TRUE(parse_curve(cycle, "a.txt", two));
  EXPECT_THAT(refusal(cycle + cycle, two),
              HasSubstr("turn again after their turn in row 13 of 50: it holds more than"));
}

// "25 2" above 25 lines of 2 columns would be a point 25 um high
TEST(ColumnTable, HasNoPointOfItsCounts) {
  const auto rows_of = [](double first_um) {
    std::string text;
    for (int i = 0; i <= 24; ++i) {
      const int step = i <= 12 ? i : 24 - i;
      text += fmt::format("{} {}\n", first_um - 0.5 * step, step < 8 ? 0.0 : 0.5 * (step - 8));
    }
    return text;
  };
  for (const char* counts : {"25 2\n", "2 25\n", "50 0\n", "exported\n25 25\n"}) {
    const auto curve = parse_curve(counts + rows_of(6.0), "a.txt", columns("height:um force:nN"));
    ASSERT_TRUE(curve) << curve.error().message;
    EXPECT_EQ(curve->points.size(), 25U) << counts;
    EXPECT_NEAR(curve->points.front().z.si, 6e-6, 1e-15) << counts;
    EXPECT_THAT(curve->metadata.remarks, testing::ElementsAre(HasSubstr("counts the 25 below it"))) << counts;
  }
  // a first point as high as the number of lines below it, one that is not their number, and one of parts
  for (const auto& [first, points] :
       {std::pair("24.5 0\n", 26U), std::pair("26 2\n", 26U), std::pair("25 0.5\n", 26U)}) {
    const auto curve = parse_curve(first + rows_of(24.0), "a.txt", columns("height:um force:nN"));
    ASSERT_TRUE(curve) << curve.error().message;
    EXPECT_EQ(curve->points.size(), points) << first;
  }
  const auto level = parse_curve("25 0\n" + rows_of(24.0), "a.txt", columns("height:um force:nN"));
  ASSERT_TRUE(level) << level.error().message;
  EXPECT_EQ(level->points.size(), 26U) << "the next step of its height";
}

TEST(ColumnTable, MakesForcesOfADeflection) {
  CurveReading reading = columns("height:um deflection:V");
  EXPECT_THAT(refusal(table("\t"), reading), HasSubstr("its deflection is in volts; give --sensitivity and"));
  reading.spring_constant = physics::Stiffness(0.1);
  EXPECT_THAT(refusal(table("\t"), reading), HasSubstr("give --sensitivity and --spring-constant"));
  reading.sensitivity_m_per_v = 50e-9;
  const auto volts = parse_curve(table("\t"), "a.txt", reading);
  ASSERT_TRUE(volts) << volts.error().message;
  EXPECT_NEAR(volts->points[12].force.si, 2.0 * 50e-9 * 0.1, 1e-20);
  reading.columns = *parse_table_columns("height:um deflection:nm");
  EXPECT_NEAR(parse_curve(table("\t"), "a.txt", reading)->points[12].force.si, 2e-9 * 0.1, 1e-20);
}

TEST(ColumnTable, TurnsASign) {
  const auto curve = parse_curve(table("\t"), "a.txt", columns("height:um force:-nN"));
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_NEAR(curve->points[12].force.si, -2e-9, 1e-21);
}

// NT-MDT's text: height, approach and retract side by side, with decimal commas.
TEST(ColumnTable, HasTheWayBackBesideTheApproach) {
  std::string text;
  for (int i = 0; i < 20; ++i)
    text += fmt::format("{},5\t{},25\t{},75\n", 1000 - 50 * i, i < 10 ? 0 : i - 10, i < 5 ? 0 : i - 5);
  const auto curve = parse_curve(text, "a.txt", columns("height:nm force:pN retract-force:pN"));
  ASSERT_TRUE(curve) << curve.error().message;
  ASSERT_EQ(curve->points.size(), 40U);
  EXPECT_NEAR(curve->points[0].z.si, 1000.5e-9, 1e-18);
  EXPECT_NEAR(curve->points[20].z.si, 50.5e-9, 1e-18);
  EXPECT_NEAR(curve->points[20].force.si, 14.75e-12, 1e-21);
  EXPECT_EQ(curve->points[20].branch, Branch::Retract);
}

TEST(ColumnTable, TakesSegmentTimeAndColumnsThatAreNotRead) {
  std::string text;
  for (int i = 0; i < 24; ++i) {
    const int step = i < 12 ? i : 23 - i;
    text += fmt::format("name{};{};{};{};{}\n", i, i < 12 ? 0 : 1, 7.0 + 1e-3 * i, 1e-6 - 1e-7 * step, 1e-9 * step);
  }
  const auto curve = parse_curve(text, "a.txt", columns("- segment time:s height:m force:N"));
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_EQ(curve->points[12].branch, Branch::Retract);
  EXPECT_NEAR(curve->time_s[5], 5e-3, 1e-12) << "counted from the first point";
}

TEST(ColumnTable, RefusesWhatItDoesNotUnderstand) {
  const CurveReading two = columns("height:um force:nN");
  EXPECT_THAT(refusal("", two), HasSubstr("it is an empty file; copy or export it again"));
  EXPECT_THAT(refusal("only words\nand more\n", two), HasSubstr("no line has 2 columns with numbers"));
  EXPECT_THAT(refusal(table("\t") + "broken\tline\n", two), HasSubstr("line 30: column 1 is \"broken\""));
  EXPECT_THAT(refusal(table("\t") + "1.0\n", two), HasSubstr("line 30 has 1 columns, and --columns names 2"));
  EXPECT_THAT(refusal(table("\t") + "nan\t1\n", two), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal("1 2\n3 4\n", two), HasSubstr("only 2 points"));
  const std::string whole = table(",");
  for (std::size_t size = 0; size < whole.size(); ++size)
    static_cast<void>(refusal(whole.substr(0, size), [&] {
      CurveReading here = two;
      here.confined = false;
      return here;
    }()));
}

// Down by 40 steps of 20 nm and back; 7 nN at the deepest point. `row` writes the number of the row, height and force.
template <class Row>
std::string rows_of(const Row& row) {
  std::string text;
  for (int i = 0; i < 80; ++i) {
    const int step = i < 40 ? i : 79 - i;
    text += row(i, 1000.0 - 20.0 * step, step < 25 ? 0.0 : 0.5 * (step - 25)) + "\n";
  }
  return text;
}

std::string german(double number) {
  std::string text = fmt::format("{:.2f}", number);
  std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

// 200 points down, 200 at rest with 2 nm of noise in which the force relaxes by a fifth, 200 up.
TEST(ColumnTable, LeavesOutARestAtItsTurn) {
  for (const double noise_nm : {0.0, 2.0}) {
    physics::NormalGenerator noise(1);
    std::string text;
    for (int i = 0; i < 600; ++i) {
      const int step = i < 200 ? i : i < 400 ? 199 : 599 - i;
      const double height_nm = 1000.0 - 9.0 * step, relaxed = 0.2 * std::clamp((i - 199) / 200.0, 0.0, 1.0);
      text += fmt::format("{} {}\n", height_nm + (i >= 200 && i < 400 ? noise_nm * noise() : 0.0),
                          (1.0 - relaxed) * 0.01 * std::max(0.0, -height_nm));
    }
    const auto curve = parse_curve(text, "a.txt", columns("height:nm force:nN"));
    ASSERT_TRUE(curve) << curve.error().message;
    const auto count = [&](Branch branch) {
      return std::count_if(curve->points.begin(), curve->points.end(),
                           [&](const physics::CurvePoint& point) { return point.branch == branch; });
    };
    EXPECT_NEAR(static_cast<double>(count(Branch::Approach)), 200.0, 3.0) << noise_nm;
    EXPECT_NEAR(static_cast<double>(count(Branch::Retract)), 200.0, 3.0) << noise_nm;
    EXPECT_THAT(curve->metadata.remarks, testing::ElementsAre(HasSubstr("the tip rests"))) << noise_nm;
  }
}

// A base that moves like a sine is slow at its turn.
TEST(ColumnTable, TakesNoSlowTurnForARest) {
  std::string text;
  for (int i = 0; i < 1000; ++i) {
    const double height_nm = 500.0 * std::cos(i * std::numbers::pi / 500.0);
    text += fmt::format("{} {}\n", height_nm, 0.01 * std::max(0.0, -height_nm));
  }
  const auto curve = parse_curve(text, "a.txt", columns("height:nm force:nN"));
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_EQ(curve->points.size(), 1000U);
  EXPECT_THAT(curve->metadata.remarks, testing::IsEmpty());
}

// 5 um of approach, of which 50 nm or 30 nm are contact, with noise: its direction is no matter of chance.
TEST(ColumnTable, FindsAShortContactAtTheEndOfALongApproach) {
  for (const double contact_nm : {50.0, 30.0}) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
      for (const double sign : {1.0, -1.0}) {
        physics::NormalGenerator noise(seed);
        std::string text;
        for (int i = 0; i < 2000; ++i) {
          const double height_nm = 5.0 * std::abs(1000 - i);
          const double force_nn = 0.04 * std::max(0.0, contact_nm - height_nm) + 0.01 * noise();
          text += fmt::format("{}\t{}\t{}\n", sign * height_nm, force_nn, i < 1000 ? 0 : 1);
        }
        const auto curve = parse_curve(text, "a.txt", columns("height:nm force:nN segment"));
        ASSERT_TRUE(curve) << seed << ": " << curve.error().message;
        EXPECT_EQ(curve->metadata.remarks.size(), sign > 0.0 ? 0U : 1U) << seed;
        EXPECT_GT(curve->points.front().z, curve->points[999].z) << seed;
        EXPECT_GT(curve->points[999].force.si, 0.5e-9) << seed << ": the contact at the end of the approach";
      }
    }
  }
}

// The last half of the contact is at the end of the detector, where the force has no noise.
TEST(ColumnTable, KeepsTheDirectionOfACurveWhoseDetectorEnded) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    physics::NormalGenerator noise(seed);
    std::string text;
    for (int i = 0; i < 1000; ++i) {
      const double push_nn = 0.008 * std::max(0, i - 500) + 0.01 * noise();
      text += fmt::format("{}\t{}\n", 1000 - i, std::min(2.0, push_nn));
    }
    const auto curve = parse_curve(text, "a.txt", columns("height:nm force:nN"));
    ASSERT_TRUE(curve) << curve.error().message;
    EXPECT_THAT(curve->metadata.remarks, testing::IsEmpty()) << seed;
  }
}

TEST(ColumnTable, TakesDecimalCommasBesideColumnsThatAreNotRead) {
  const std::string text =
      rows_of([](int i, double z, double f) { return fmt::format("{} {} {}", german(z), i, german(f)); });
  const auto curve = parse_curve(text, "a.txt", columns("height:nm - force:nN"));
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_NEAR(curve->points[0].z.si, 1000e-9, 1e-18);
  EXPECT_NEAR(curve->points[39].force.si, 7e-9, 1e-20);
}

TEST(ColumnTable, RefusesDecimalCommasBetweenCommas) {
  const CurveReading two = columns("height:nm force:nN");
  const auto row = [](int, double z, double f) { return german(z) + "," + german(f); };
  EXPECT_THAT(refusal(rows_of(row), two), HasSubstr("line 1 has 4 fields between commas, and --columns names 2"));
  const auto closed = [](int, double z, double f) { return fmt::format("{},{},", z, f); };
  EXPECT_EQ(refusal(rows_of(closed), two), "accepted") << "a comma at the end of each line";
  const auto wider = [](int i, double z, double f) { return fmt::format("{},{:.1f},{}", z, f, i); };
  EXPECT_EQ(refusal(rows_of(wider), two), "accepted") << "a third column of numbers with points";
}

// 998.5 and 1,000 are no neighbours of 999.25
TEST(ColumnTable, RefusesSeparatorsOfThousands) {
  const CurveReading two = columns("height:nm force:nN");
  const auto row = [](int, double z, double f) {
    return fmt::format("{}\t{:.1f}", z < 1000.0 ? fmt::format("{:.1f}", z) : "1,000", f);
  };
  EXPECT_THAT(refusal(rows_of(row), two), HasSubstr("line 1: its numbers have points and commas"));
  for (const char* number : {"1,000,000", "1.000,5", "1,000.5", "5,", ",5"}) {
    EXPECT_THAT(refusal("1\t2\n" + std::string(number) + "\t3\n", two), HasSubstr("not a finite number")) << number;
  }
}

TEST(ColumnTable, ReadsNumbersInQuotes) {
  const auto row = [](int, double z, double f) { return fmt::format("\"{}\",\"{}\"", z, f); };
  const auto curve = parse_curve(rows_of(row), "a.csv", columns("height:nm force:nN"));
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_NEAR(curve->points[39].force.si, 7e-9, 1e-20);
}

TEST(ColumnTable, ComparesItsHeadingWithTheUnits) {
  const auto remarks = [](const std::string& heading, const char* units) {
    const std::string text = heading + "\n" + table("\t");
    const auto curve = parse_curve(text.substr(0, heading.size() + 1) + text.substr(text.find("\n1.20\t") + 1), "a.txt",
                                   columns(units));
    EXPECT_TRUE(curve) << curve.error().message;
    return curve ? curve->metadata.remarks : std::vector<std::string>();
  };
  EXPECT_THAT(remarks("Height (um)\tForce (nN)", "height:nm force:nN"),
              testing::ElementsAre("the heading of column 1 is \"Height (um)\", and --columns names another unit"));
  EXPECT_THAT(remarks("# z [um]\tdeflection [V]", "height:um force:nN"), testing::ElementsAre(HasSubstr("column 2")));
  EXPECT_THAT(remarks("Height (\u00b5m)\tForce (nN)", "height:um force:-nN"), testing::IsEmpty());
  EXPECT_THAT(remarks("Height (raw)\tForce", "height:um force:nN"), testing::IsEmpty());
  for (const char* heading : {"z / nm\tF / nN", "Height_nm\tForce_nN", "z, nm\tF, nN", "height: nm\tforce: nN"}) {
    EXPECT_THAT(remarks(heading, "height:um force:nN"), testing::ElementsAre(HasSubstr("column 1"))) << heading;
    EXPECT_THAT(remarks(heading, "height:nm force:nN"), testing::IsEmpty()) << heading;
  }
  EXPECT_THAT(remarks("z / m\tin the N", "height:um force:nN"), testing::ElementsAre(HasSubstr("column 1")));
  EXPECT_THAT(remarks("curve A\tchannel V", "height:um force:nN"), testing::IsEmpty());
  // units in a line of their own, above a rule, and below a line about something else
  for (const char* heading : {"z\tF\nnm\tnN", "z/nm\tF/nN\n----", "# z (nm)\tF (nN)\n#", "units:\tnm\tnN"}) {
    EXPECT_THAT(remarks(heading, "height:um force:nN"), testing::ElementsAre(HasSubstr("column 1"))) << heading;
    EXPECT_THAT(remarks(heading, "height:nm force:nN"), testing::IsEmpty()) << heading;
  }
  EXPECT_THAT(remarks("range (nm)\t3500\nz (um)\tF", "height:um force:nN"), testing::IsEmpty());
  EXPECT_THAT(remarks("range (nm)\t3500\nz\tF", "height:um force:nN"), testing::IsEmpty());
}

TEST(ColumnTable, SaysThatItHasMoreColumns) {
  const auto row = [](int i, double z, double f) { return fmt::format("{}\t{}\t{}", z, f, i); };
  const auto wider = parse_curve(rows_of(row), "a.txt", columns("height:nm force:nN"));
  ASSERT_TRUE(wider);
  EXPECT_THAT(wider->metadata.remarks, testing::ElementsAre(HasSubstr("line 1 has 3 columns, and --columns names 2")));
  EXPECT_THAT(parse_curve(rows_of(row), "a.txt", columns("height:nm force:nN -"))->metadata.remarks,
              testing::IsEmpty());
}

TEST(ColumnTable, SaysWhyNoLineFits) {
  const CurveReading two = columns("height:nm force:nN");
  EXPECT_THAT(refusal("1/2\n", two), HasSubstr("; its last line is \"1/2\""));
  EXPECT_THAT(refusal(std::string("\xff\xfe"
                                  "1\0\t\0002\0\n\0",
                                  10),
                      two),
              HasSubstr("it is a text in UTF-16; save it in UTF-8"));
}

TEST(TableColumns, AreNamedWithTheirUnits) {
  const auto error = [](const char* text) {
    const auto parsed = parse_table_columns(text);
    return parsed ? "accepted" : parsed.error().message;
  };
  EXPECT_EQ(error(" height:pm   force:uN "), "accepted");
  EXPECT_EQ(error("height:um deflection:mV time:ms - segment"), "accepted");
  EXPECT_THAT(error("height:um power:W"), HasSubstr("\"power:W\" is not a column; write NAME:UNIT"));
  EXPECT_THAT(error("height:nN force:nN"), HasSubstr("\"height:nN\" has no unit of its quantity"));
  EXPECT_THAT(error("height force:nN"), HasSubstr("has no unit of its quantity"));
  for (const char* text :
       {"", "height:um", "force:nN", "height:um height:nm force:nN", "height:um force:nN deflection:V"}) {
    EXPECT_THAT(error(text), HasSubstr("one height or tip-position, and one force or deflection")) << text;
  }
  EXPECT_THAT(error("height:um force:nN retract-deflection:V"), HasSubstr("the same quantity"));
  EXPECT_THAT(error("height:um force:nN retract-force:nN segment"), HasSubstr("neither segment nor time"));
}

}  // namespace column_table_test
}  // namespace afm::curves
