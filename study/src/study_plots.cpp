// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "curves/svg_plot.h"
#include "study_page.h"

namespace afm::study {

namespace {

using curves::SvgLine;
using curves::SvgMark;
using curves::SvgPlot;

constexpr int kPlotHeight = 440;

// A dot with its interval as a bar.
void add_interval(SvgPlot& plot, double x, double value, const Interval& interval, std::size_t color,
                  const std::string& label) {
  if (!std::isfinite(value)) return;
  const std::string css(curves::distinct_color(color));
  plot.marks.push_back({{x, value}, label, css, SvgMark::Side::Right});
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return;
  plot.lines.push_back({"", css, curves::LineStyle::Solid, {{x, interval.low}, {x, interval.high}}});
}

void add_key(SvgPlot& plot, const std::string& label, std::size_t color, curves::LineStyle style) {
  plot.lines.push_back({label, std::string(curves::distinct_color(color)), style, {}});
}

void add_level(SvgPlot& plot, const std::string& label, double from, double to, double y) {
  plot.lines.push_back({label, "#3c434b", curves::LineStyle::Dashed, {{from, y}, {to, y}}});
}

// Bin of a fifth of a decade of levels, with its share of right answers.
struct LevelBin {
  double level;
  Estimate right;
};
std::vector<LevelBin> level_bins(const ThresholdResult& result) {
  constexpr double kBinsPerDecade = 5.0;
  std::map<int, std::pair<double, std::pair<std::size_t, std::size_t>>> bins;  // sum of logarithms, right and all
  for (const ThresholdResult::Level& level : result.levels) {
    if (!(level.level > 0.0)) continue;
    const double place = std::log10(level.level);
    auto& [sum, counts] = bins[static_cast<int>(std::floor(place * kBinsPerDecade))];
    sum += place * static_cast<double>(level.right.n);
    counts.first += static_cast<std::size_t>(std::lround(level.right.value * static_cast<double>(level.right.n)));
    counts.second += level.right.n;
  }
  std::vector<LevelBin> list;
  for (const auto& [bin, content] : bins) {
    const auto& [sum, counts] = content;
    list.push_back({std::pow(10.0, sum / static_cast<double>(counts.second)), proportion(counts.first, counts.second)});
  }
  return list;
}

}  // namespace

std::string survey_svg(const std::vector<SurveyResult>& survey) {
  SvgPlot plot;
  plot.title = "The paper's eight questions";
  plot.x_label = "question";
  plot.y_label = "mean answer, 0 to 4";
  plot.height = kPlotHeight;
  add_key(plot, "this study", 0, curves::LineStyle::Solid);
  add_key(plot, "Liu & Peng, Table 3", 1, curves::LineStyle::Solid);
  constexpr double kAside = 0.1;
  for (std::size_t i = 0; i < survey.size(); ++i) {
    const double x = static_cast<double>(i) + 1.0;
    const Summary printed = printed_summary(survey_questions()[i]);
    add_interval(plot, x - kAside, survey[i].answers.mean, survey[i].interval, 0, "");
    add_interval(plot, x + kAside, printed.mean, t_interval(printed), 1, "");
  }
  return curves::svg(plot);
}

std::string identify_svg(const LessonResults& lesson) {
  SvgPlot plot;
  plot.title = lesson.task + ": blind identification";
  plot.x_label = "step and condition, in the order of the table";
  plot.y_label = "share right";
  plot.height = kPlotHeight;
  const double last = static_cast<double>(lesson.identify.size()) + 0.6;
  for (std::size_t i = 0; i < lesson.identify.size(); ++i) {
    const IdentifyResult& result = lesson.identify[i];
    add_interval(plot, static_cast<double>(i) + 1.0, result.accuracy.value, result.accuracy.interval, i,
                 result.condition.empty() ? result.step : result.step + ", " + result.condition);
  }
  add_level(plot, "chance", 0.6, last, lesson.identify.front().chance);
  add_level(plot, "", 0.6, last, 1.0);
  return curves::svg(plot);
}

std::string thresholds_svg(const LessonResults& lesson) {
  SvgPlot plot;
  plot.title = lesson.task + ": which one needed more force to let go?";
  plot.x_label = "level w, the stronger pull-off force is 1 + w times the weaker one";
  plot.y_label = "share right";
  plot.height = kPlotHeight;
  double lowest = 1.0, highest = 0.0;
  for (std::size_t i = 0; i < lesson.thresholds.size(); ++i) {
    const ThresholdResult& result = lesson.thresholds[i];
    add_key(plot, result.condition.empty() ? result.step : result.step + ", " + result.condition, i,
            curves::LineStyle::Solid);
    for (const LevelBin& bin : level_bins(result)) {
      lowest = std::min(lowest, bin.level);
      highest = std::max(highest, bin.level);
      // shifted sideways if conditions share a level
      add_interval(plot, bin.level * (1.0 + 0.03 * static_cast<double>(i)), bin.right.value, bin.right.interval, i, "");
    }
  }
  if (highest > 0.0) {
    add_level(plot, "threshold, 75 %", lowest, highest, 0.75);
    add_level(plot, "", lowest, highest, 0.5);
  }
  return curves::svg(plot);
}

}  // namespace afm::study
