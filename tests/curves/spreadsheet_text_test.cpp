// SPDX-License-Identifier: Apache-2.0
// Curves that a spreadsheet has saved again.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "curves/curve_file.h"

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

}  // namespace spreadsheet_text_test
}  // namespace afm::curves
