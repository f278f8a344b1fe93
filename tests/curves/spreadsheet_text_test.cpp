// SPDX-License-Identifier: Apache-2.0
// Curves that a spreadsheet has saved again, and plain tables as spreadsheets and data frames write them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "curves/curve_file.h"
#include "curves/table_columns.h"

namespace afm::curves {
namespace spreadsheet_text_test {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct Written {
  std::string heading, columns, rows;
};

// Down by 12 steps of 1 nm and back.
Written touchafm_curve() {
  Written curve{
      "# TouchAFM force-displacement curve\n# signs: force > 0 repels, z falls\n# spring_constant_N_per_m: 0.1\n"
      "# samples: 24\n",
      "z_m,force_N,branch\n",
      {}};
  for (int i = 0; i < 24; ++i) {
    curve.rows += fmt::format("{:.2e},{:.2e},{}\n", 1e-9 * (i < 12 ? 6.5 - i : i - 16.5), i == 11 || i == 12 ? 1e-9 : 0,
                              i < 12 ? "approach" : "retract");
  }
  return curve;
}

Written workshop_curve() {
  Written curve{"Force-Distance Curve\r\nFile Format:\t3\r\nForce Constant, nN/nm:\t0.1\r\n\r\n",
                "Extend Z-Sense(nm),Extend Force(nN),Retract Z-Sense(nm),Retract Force(nN)\r\n",
                {}};
  for (int i = 0; i < 12; ++i)
    curve.rows += fmt::format("{:.2f},{},{:.2f},{}\r\n", i - 6.5, i == 11 ? 1.0 : 0.0, 4.5 - i, i == 0 ? 1.0 : 0.0);
  return curve;
}

// Every line above the columns filled with empty cells, and some cells in quotes.
std::string padded(const Written& curve, const std::string& cells) {
  std::string text;
  for (const char c : curve.heading) {
    if (c == '\n') text.insert(text.ends_with('\r') ? text.size() - 1 : text.size(), cells);
    text.push_back(c);
  }
  return text;
}

std::string german(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) { return c == ',' ? ';' : c == '.' ? ',' : c; });
  return text;
}

void expect_whole(const std::string& bytes) {
  const auto curve = parse_curve(bytes, "curve.csv");
  ASSERT_TRUE(curve) << curve.error().message;
  ASSERT_EQ(curve->points.size(), 24U);
  EXPECT_NEAR(curve->points[0].z.si, 6.5e-9, 1e-20);
  EXPECT_NEAR(curve->points[11].force.si, 1e-9, 1e-20);
  EXPECT_EQ(curve->points[12].branch, physics::Branch::Retract);
  ASSERT_TRUE(curve->metadata.spring_constant);
  EXPECT_DOUBLE_EQ(curve->metadata.spring_constant->si, 0.1);
  EXPECT_THAT(curve->metadata.remarks, Contains(HasSubstr("a spreadsheet saved it again")));
}

TEST(SpreadsheetText, IsACurveAgain) {
  for (const Written& curve : {touchafm_curve(), workshop_curve()}) {
    expect_whole(padded(curve, ",,") + curve.columns + curve.rows);
    expect_whole(padded(curve, ";;") + german(curve.columns) + german(curve.rows));
    std::string semicolons = padded(curve, ";");
    std::replace(semicolons.begin(), semicolons.end(), ',', ';');
    expect_whole(semicolons + german(curve.columns) + german(curve.rows) + "\n");
  }
}

TEST(SpreadsheetText, HasItsQuotedCells) {
  const Written curve = touchafm_curve();
  expect_whole("# TouchAFM force-displacement curve\n\"# note: the \"\"second\"\" one, of mica\"\n" +
               curve.heading.substr(curve.heading.find('\n') + 1) + curve.columns + curve.rows + "\n\n");
}

TEST(SpreadsheetText, MayHaveBlankLines) {
  const Written curve = touchafm_curve();
  std::string text;
  for (const char c : curve.heading + curve.columns + curve.rows) text += c == '\n' ? "\n\n" : std::string(1, c);
  const auto read = parse_curve(text, "curve.csv");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->points.size(), 24U);
}

TEST(SpreadsheetText, IsNoneWithoutItsTraces) {
  for (const Written& curve : {touchafm_curve(), workshop_curve()}) {
    const auto read = parse_curve(curve.heading + curve.columns + curve.rows, "curve.csv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_THAT(read->metadata.remarks, Not(Contains(HasSubstr("spreadsheet"))));
  }
}

// A plain table of 60 rows down and 60 back: heights of 1800 to 30, forces of 0 to 20, as `row` writes them.
template <class Row>
std::string plain_table(const Row& row) {
  std::string text;
  for (int i = 0; i < 120; ++i) {
    const int step = i < 60 ? i : 119 - i;
    text += row(1800 - 30 * step, std::max(0, step - 39)) + "\n";
  }
  return text;
}

core::Result<RecordedCurve> read_plain(const std::string& text) {
  CurveReading reading;
  if (const auto columns = parse_table_columns("height:nm force:nN")) reading.columns = *columns;
  return parse_curve(text, "a.csv", reading);
}

std::string refusal_of_plain(const std::string& text) {
  const auto curve = read_plain(text);
  return curve ? "accepted" : curve.error().message;
}

// as pandas writes it with decimal=","
TEST(PlainTable, HasDecimalCommasInQuotesBetweenCommas) {
  const auto curve =
      read_plain("height,force\n" + plain_table([](int z, int f) { return fmt::format("\"{},50\",\"{},25\"", z, f); }));
  ASSERT_TRUE(curve) << curve.error().message;
  ASSERT_EQ(curve->points.size(), 120U);
  EXPECT_NEAR(curve->points[0].z.si, 1800.5e-9, 1e-18);
  EXPECT_NEAR(curve->points[59].force.si, 20.25e-9, 1e-20);
  EXPECT_THAT(curve->metadata.remarks, testing::IsEmpty());
}

TEST(PlainTable, HasNoBreakSpacesAroundItsNumbers) {
  for (const std::string blank : {"\u00a0", "\u202f"}) {
    const auto curve =
        read_plain(plain_table([&](int z, int f) { return fmt::format("{}{}\t{}{}", blank, z, f, blank); }));
    ASSERT_TRUE(curve) << curve.error().message;
    EXPECT_NEAR(curve->points[0].z.si, 1800e-9, 1e-18);
  }
}

// 1,020 above 990: read as a decimal comma, the heights would be 1.02 nm and 990 nm.
TEST(PlainTable, WithSeparatorsOfThousandsInWholeNumbersIsRefused) {
  const auto with_thousands = [](int z) {
    return z < 1000 ? fmt::format("{}", z) : fmt::format("{},{:03}", z / 1000, z % 1000);
  };
  for (const char* form : {"{}\t{}", "{};{}", "\"{}\",\"{}\""}) {
    const std::string text =
        plain_table([&](int z, int f) { return fmt::format(fmt::runtime(form), with_thousands(z), f); });
    EXPECT_THAT(refusal_of_plain(text), HasSubstr("column 1 has \"1,800\" and whole numbers without a comma")) << form;
  }
  const auto decimals = [](int z, int f) { return fmt::format("{},{:03}\t{}", z / 1000, z % 1000, f); };
  EXPECT_EQ(refusal_of_plain(plain_table(decimals)), "accepted") << "1,800 to 0,030 are decimal commas";
}

TEST(PlainTable, WithAFactorAboveItIsRefused) {
  const std::string rows =
      plain_table([](int z, int f) { return fmt::format("   {:.4f}    {:.4f}", z * 1e-3, f * 1e-3); });
  EXPECT_THAT(
      refusal_of_plain("z =\n\n   1.0e+03 *\n\n" + rows),
      HasSubstr("\"1.0e+03 *\" above its numbers is a factor, as MATLAB prints one: write the numbers without it"));
  EXPECT_EQ(refusal_of_plain("heights * factor\n" + rows), "accepted");
}

TEST(PlainTable, SaysThatItsLastLineHasNoEnd) {
  const std::string whole = plain_table([](int z, int f) { return fmt::format("{}\t{}.25", z, f); });
  EXPECT_THAT(read_plain(whole)->metadata.remarks, testing::IsEmpty());
  EXPECT_THAT(read_plain(whole.substr(0, whole.size() - 1))->metadata.remarks,
              testing::ElementsAre("its last line has no end, and may have lost digits"));
}

TEST(TableColumns, AreSeparatedByBlanks) {
  for (const char* text :
       {"height:nm,force:nN", "height:nm, force:nN", "height:nm;force:nN", "height:nm\u00a0force:nN"}) {
    const auto parsed = parse_table_columns(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_THAT(parsed.error().message, HasSubstr("separate the columns by blanks")) << text;
  }
}

}  // namespace spreadsheet_text_test
}  // namespace afm::curves
