// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace afm::curves {

struct SvgPoint {
  double x = 0;
  double y = 0;
};

enum class LineStyle { Solid, Dashed };

struct SvgLine {
  std::string label;  // legend entry; empty: not in the legend
  std::string color;  // colour in CSS notation
  LineStyle style = LineStyle::Solid;
  std::vector<SvgPoint> points;  // points of the line, which breaks at one that is not finite
};

// A dot on the plot with a text next to it, or only a text.
struct SvgMark {
  SvgPoint at;
  std::string text;  // text next to the dot; empty: only the dot
  std::string color;
  enum class Side { Left, Right, Above, Below, Centre } side = Side::Right;  // Centre: in place of the dot
};

enum class AxisScale { Linear, Logarithmic };

struct SvgPlot {
  std::string title;
  std::string x_label;  // label with the unit
  std::string y_label;  // label with the unit
  std::vector<SvgLine> lines;
  std::vector<SvgMark> marks;
  AxisScale x_scale = AxisScale::Linear;  // scale of x; logarithmic: the line breaks at values <= 0
  AxisScale y_scale = AxisScale::Linear;
  std::string about;  // parameters and sources that the file keeps unseen, as lines
  char decimal_mark = '.';
  int width = 960;
  int height = 600;
};

// Colours that people with any colour vision can distinguish (Okabe & Ito 2008), dark enough for a white background;
// repeats.
std::string_view distinct_color(std::size_t index);

// The points needed to draw the line within `tolerance` of the original (Ramer 1972, Douglas & Peucker 1973). Always
// keeps the first, the last and the extremes of both coordinates.
std::vector<SvgPoint> simplified(std::span<const SvgPoint> points, double tolerance);

// One <svg> element with a size, axes at round numbers or powers of ten, and both zero lines, for use in HTML or, since
// it has its namespace, as a separate file. Lines are simplified to a tenth of a pixel. An empty plot has axes from 0
// to 1.
std::string svg(const SvgPlot& plot);

// Several plots below each other in one <svg> element.
std::string svg(std::span<const SvgPlot> column);

}  // namespace afm::curves
