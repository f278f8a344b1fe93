// SPDX-License-Identifier: Apache-2.0
#include "curves/svg_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace afm::curves {
namespace svg_plot_test {

using testing::HasSubstr;
using testing::Not;

TEST(SimplifiedLine, KeepsOnlyTheCornersOfStraightRuns) {
  std::vector<SvgPoint> corner;
  for (int i = 0; i <= 1000; ++i) corner.push_back({0.1 * i, 0});
  for (int i = 1; i <= 1000; ++i) corner.push_back({100, 0.1 * i});
  const auto kept = simplified(corner, 0.01);
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[1].x, 100);
  EXPECT_EQ(kept[1].y, 0);
}

TEST(SimplifiedLine, KeepsEveryExtreme) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  std::vector<SvgPoint> points;
  for (int i = 0; i < 5000; ++i) points.push_back({0.1 * i, noise(random)});
  const auto by_y = [](SvgPoint a, SvgPoint b) { return a.y < b.y; };
  const auto kept = simplified(points, 2.0);
  EXPECT_LT(kept.size(), points.size());
  EXPECT_EQ(std::min_element(kept.begin(), kept.end(), by_y)->y,
            std::min_element(points.begin(), points.end(), by_y)->y);
  EXPECT_EQ(std::max_element(kept.begin(), kept.end(), by_y)->y,
            std::max_element(points.begin(), points.end(), by_y)->y);
}

TEST(SimplifiedLine, StaysWithinItsTolerance) {
  std::vector<SvgPoint> circle;
  for (int i = 0; i <= 3600; ++i) circle.push_back({100 * std::cos(i * 1e-3), 100 * std::sin(i * 1e-3)});
  const auto kept = simplified(circle, 0.1);
  EXPECT_LT(kept.size(), 100U);
  // the middle of each chord lies at most the tolerance inside the circle
  for (std::size_t i = 1; i < kept.size(); ++i) {
    EXPECT_GT(std::hypot(kept[i].x + kept[i - 1].x, kept[i].y + kept[i - 1].y) / 2, 99.89);
  }
}

TEST(SimplifiedLine, LeavesShortLinesAlone) {
  EXPECT_TRUE(simplified({}, 1).empty());
  const std::vector<SvgPoint> two{{0, 0}, {0, 0}};
  EXPECT_EQ(simplified(two, 1).size(), 2U);
}

TEST(SvgPlot, EscapesWhatPeopleWrite) {
  SvgPlot plot;
  plot.title = "a < b & \"c\"";
  plot.lines.push_back({"x > y", "#000", LineStyle::Solid, {{0, 0}, {1, 1}}});
  const std::string text = svg(plot);
  EXPECT_THAT(text, HasSubstr("a &lt; b &amp; &quot;c&quot;"));
  plot.title = "gel\xFF\x01.h5";
  EXPECT_THAT(svg(plot), HasSubstr("gel\xEF\xBF\xBD\xEF\xBF\xBD.h5")) << "no XML otherwise";
  EXPECT_THAT(text, HasSubstr("x &gt; y"));
}

TEST(SvgPlot, BreaksALineWhereANumberIsMissing) {
  SvgPlot plot;
  plot.lines.push_back({"", "#123456", LineStyle::Dashed, {{0, 0}, {1, 1}, {std::nan(""), 0}, {2, 0}, {3, 1}}});
  const std::string text = svg(plot);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  const std::size_t path = text.find("stroke=\"#123456\"");
  ASSERT_NE(path, std::string::npos);
  const std::size_t begin = text.rfind("<path", path);
  EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(begin),
                       text.begin() + static_cast<std::ptrdiff_t>(path), 'M'),
            2);
}

TEST(SvgPlot, WritesPowersOfTenOnALogarithmicAxis) {
  SvgPlot plot;
  plot.x_scale = AxisScale::Logarithmic;
  plot.lines.push_back({"", "#123456", LineStyle::Solid, {{0.01, 0}, {1, 1}, {0, 5}, {-1, 5}, {10, 0}, {1000, 1}}});
  plot.marks.push_back({{1, 1}, "here", "#000", SvgMark::Side::Centre});
  const std::string text = svg(plot);
  for (const char* tick : {">10\u207b\u00b2<", ">10\u2070<", ">10\u00b3<"}) EXPECT_THAT(text, HasSubstr(tick));
  EXPECT_THAT(text, HasSubstr(">here<"));
  EXPECT_THAT(text, Not(HasSubstr("<circle")));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  // values that are not positive break the line in two
  const std::size_t path = text.find("stroke=\"#123456\"");
  const std::size_t begin = text.rfind("<path", path);
  EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(begin),
                       text.begin() + static_cast<std::ptrdiff_t>(path), 'M'),
            2);
}

TEST(SvgPlot, DrawsAxesForNothingAtAll) {
  for (const auto& points : {std::vector<SvgPoint>{}, std::vector<SvgPoint>{{5, 5}}, std::vector<SvgPoint>{{0, 0}}}) {
    SvgPlot plot;
    plot.lines.push_back({"empty", "#000", LineStyle::Solid, points});
    const std::string text = svg(plot);
    EXPECT_THAT(text, Not(HasSubstr("nan")));
    EXPECT_THAT(text, Not(HasSubstr("inf")));
    for (const char* part : {"<svg", "<path d=", "text-anchor=\"middle\">", "</svg>"})
      EXPECT_THAT(text, HasSubstr(part));
  }
}

// The numbers of the axes lie beyond its ends.
TEST(SvgPlot, KeepsTheTextOfAMarkWithinTheAxes) {
  const auto anchor_of_text = [](double x, SvgMark::Side side, const std::string& text) {
    SvgPlot plot;
    plot.lines.push_back({"line", "#000", LineStyle::Solid, {{0, 0}, {100, 1}}});
    plot.marks.push_back({{x, 0.5}, text, "#000", side});
    const std::string drawn = svg(plot);
    const std::size_t end = drawn.find(">" + text), begin = drawn.rfind("text-anchor=\"", end) + 13;
    return drawn.substr(begin, drawn.find('"', begin) - begin);
  };
  const std::string event = "pull-off: 100.3 nm, \u221210 nN";
  EXPECT_EQ(anchor_of_text(5, SvgMark::Side::Left, event), "start");
  EXPECT_EQ(anchor_of_text(95, SvgMark::Side::Right, event), "end");
  EXPECT_EQ(anchor_of_text(50, SvgMark::Side::Left, event), "end");
  EXPECT_EQ(anchor_of_text(50, SvgMark::Side::Right, event), "start");
  EXPECT_EQ(anchor_of_text(5, SvgMark::Side::Left, std::string(200, 'x')), "end") << "fits on no side";
}

}  // namespace svg_plot_test
}  // namespace afm::curves
